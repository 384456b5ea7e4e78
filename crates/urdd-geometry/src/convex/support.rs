//! Support functions for all lanes at once: the farthest vertex in a direction, in constant time.
//!
//! The directions are divided into cells ([`candidates`]). Most cells list one to four vertices, so four dot products find
//! the farthest, however many vertices the shape has.

use fearless_simd::{Level, Simd, dispatch, f64x4, prelude::*, u64x4};
use nalgebra::Vector3;

use super::{ConvexShape, OrientedBox};
use crate::lanes::{LANES, Num, Vec3, select, splat};

/// A shape, relative to its centre, with a support function.
pub(crate) trait Support: Sync {
    /// The type of the shape in one lane.
    type Single: Support;

    /// The shape in one lane, to be used in all lanes.
    fn single(&self, lane: usize) -> &Self::Single;

    /// The farthest point in each lane's direction. If a direction is zero, or its lane is not in the bit set `lanes`,
    /// the result may be any point.
    fn support<S: Simd>(&self, simd: S, direction: Vec3<S>, lanes: u64) -> Vec3<S>;
}

impl Support for OrientedBox {
    type Single = Self;

    #[inline(always)]
    fn single(&self, _lane: usize) -> &Self {
        self
    }

    #[inline(always)]
    fn support<S: Simd>(&self, simd: S, direction: Vec3<S>, _lanes: u64) -> Vec3<S> {
        let h = Vec3::splat(simd, self.half_extents);
        Vec3 {
            x: h.x.copysign(direction.x),
            y: h.y.copysign(direction.y),
            z: h.z.copysign(direction.z),
        }
    }
}

impl Support for ConvexShape {
    type Single = Self;

    #[inline(always)]
    fn single(&self, _lane: usize) -> &Self {
        self
    }

    #[inline(always)]
    fn support<S: Simd>(&self, simd: S, d: Vec3<S>, lanes: u64) -> Vec3<S> {
        let cells = cells(simd, splat(simd, self.table.side() as f64), d);
        farthest(simd, |_| &self.table, cells, d, lanes)
    }
}

impl ConvexShape {
    /// The vertex that is farthest in a direction, in the body frame, metres.
    pub(crate) fn farthest(&self, level: Level, direction: Vector3<f64>) -> Vector3<f64> {
        let found = dispatch!(level, simd => {
            self.support(simd, Vec3::splat(simd, direction.into()), 1).lane(0)
        });
        Vector3::from(found) + Vector3::from(self.centre)
    }
}

/// The farthest vertices in the directions of `cells`, from the table of each lane. In lanes that are not in the bit set
/// `lanes`, any points.
#[inline(always)]
pub(crate) fn farthest<'a, S: Simd>(
    simd: S,
    table: impl Fn(usize) -> &'a SupportTable,
    cells: [usize; LANES],
    d: Vec3<S>,
    mut lanes: u64,
) -> Vec3<S> {
    let (mut x, mut y, mut z) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    if lanes.count_ones() > 5 {
        for lane in 0..LANES {
            [x[lane], y[lane], z[lane]] = table(lane).farthest(simd, cells[lane], d.lane(lane));
        }
    } else {
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize & (LANES - 1);
            lanes &= lanes - 1;
            [x[lane], y[lane], z[lane]] = table(lane).farthest(simd, cells[lane], d.lane(lane));
        }
    }
    Vec3 { x: Num::load_array(simd, x), y: Num::load_array(simd, y), z: Num::load_array(simd, z) }
}

/// The cell of each lane's direction, in a table with `side` cells along one side.
#[inline(always)]
pub(crate) fn cells<S: Simd>(simd: S, side: Num<S>, d: Vec3<S>) -> [usize; LANES] {
    /// 1.5 * 2^52: adding it rounds to an integer, which the lowest bits of the sum then contain.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let (zero, one) = (splat(simd, 0.0), splat(simd, 1.0));
    let half = side * splat(simd, 0.5);
    let inverse = one / (d.x.abs() + d.y.abs() + d.z.abs());
    let (u, v) = (d.x * inverse, d.y * inverse);
    let lower = d.z.simd_lt(zero);
    let u2 = select(lower, (one - v.abs()).copysign(u), u);
    let v2 = select(lower, (one - u.abs()).copysign(v), v);
    // Slightly less than the side, so that no index exceeds the table; too little to miss a vertex.
    let scale = half * splat(simd, 1.0 - 1e-12);
    let shift = half - splat(simd, 0.5);
    let round = splat(simd, ROUND);
    let row = (u2 * scale + shift + round) - round;
    let column = (v2 * scale + shift + round) - round;
    let cell = (row * side + column + round).to_array();
    let mut cells = [0; LANES];
    for lane in 0..LANES {
        cells[lane] = (cell[lane].to_bits() & 0xFFFF_FFFF) as usize;
    }
    cells
}

/// Vertices per block.
pub(crate) const WIDTH: usize = 4;

/// Candidates of a cell, padded by repetition.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Block {
    pub x: [f64; WIDTH],
    pub y: [f64; WIDTH],
    pub z: [f64; WIDTH],
    /// Whether the next block continues the same list.
    pub more: bool,
}

/// For each cell of directions, the vertices that are farthest in some direction of it.
#[derive(Clone, Debug)]
pub(crate) struct SupportTable {
    /// Cells along one side of the square map: a power of two.
    side: usize,
    /// The first block of each cell, row by row. Cells share blocks: a cell with few candidates reuses a block that
    /// contains them, so that the blocks fit the cache.
    cells: Vec<u32>,
    blocks: Vec<Block>,
}

impl SupportTable {
    /// From at least one point, all finite.
    pub fn new(points: &[[f64; 3]]) -> Self {
        let side = if points.len() < 24 { 32 } else { 64 };
        let lists = candidates(points, side);
        let mut cells = vec![0; side * side];
        let mut blocks = Vec::new();
        // Longest lists first, then in the order of the cells.
        let mut order: Vec<usize> = (0..lists.len()).collect();
        order.sort_by_key(|&cell| std::cmp::Reverse(lists[cell].len()));
        // For each vertex, the single-block lists that contain it.
        let mut shared: Vec<Vec<(u32, &[u32])>> = vec![Vec::new(); points.len()];
        for cell in order {
            let list = &lists[cell];
            let known = shared[list[0] as usize]
                .iter()
                .find(|(_, other)| list.iter().all(|i| other.contains(i)));
            if let Some(&(block, _)) = known {
                cells[cell] = block;
                continue;
            }
            cells[cell] = blocks.len() as u32;
            if list.len() <= WIDTH {
                for &i in list {
                    shared[i as usize].push((cells[cell], list));
                }
            }
            for (k, chunk) in list.chunks(WIDTH).enumerate() {
                let of = |axis: usize| {
                    std::array::from_fn(|i| points[chunk[i.min(chunk.len() - 1)] as usize][axis])
                };
                blocks.push(Block {
                    x: of(0),
                    y: of(1),
                    z: of(2),
                    more: (k + 1) * WIDTH < list.len(),
                });
            }
        }
        Self { side, cells, blocks }
    }

    /// Cells along one side of the map.
    #[inline(always)]
    pub fn side(&self) -> usize {
        self.side
    }

    /// The vertex that is farthest in a direction of a cell. Out-of-range cell numbers wrap around.
    #[inline(always)]
    pub fn farthest<S: Simd>(&self, simd: S, cell: usize, d: [f64; 3]) -> [f64; 3] {
        let mut at = self.cells[cell & (self.cells.len() - 1)] as usize;
        let mut block = &self.blocks[at];
        let mut most = greatest(simd, block, d);
        let mut k = (most.to_bits() & (WIDTH as u64 - 1)) as usize;
        let mut point = [block.x[k], block.y[k], block.z[k]];
        while block.more {
            at += 1;
            block = &self.blocks[at];
            let other = greatest(simd, block, d);
            if other > most {
                most = other;
                k = (most.to_bits() & (WIDTH as u64 - 1)) as usize;
                point = [block.x[k], block.y[k], block.z[k]];
            }
        }
        point
    }
}

/// The greatest dot product of a block's vertices with a direction.
///
/// The lowest bits of each product are replaced by the index of its vertex, to find the greatest without branches. This
/// changes the product by less than 2^-50 of its value.
#[inline(always)]
fn greatest<S: Simd>(simd: S, block: &Block, d: [f64; 3]) -> f64 {
    let dots = f64x4::load_array_ref(simd, &block.x) * d[0]
        + f64x4::load_array_ref(simd, &block.y) * d[1]
        + f64x4::load_array_ref(simd, &block.z) * d[2];
    let rest = u64x4::splat(simd, !(WIDTH as u64 - 1));
    let numbers = u64x4::load_array(simd, [0, 1, 2, 3]);
    let marked: f64x4<S> = ((dots.bitcast::<u64x4<S>>() & rest) | numbers).bitcast();
    marked.reduce_max()
}

/// For each cell, row by row, the indices of the points that are farthest in some direction of the cell.
///
/// The cells divide an octahedral map of the sphere onto a square of `side` x `side` cells (Cigolle et al., "A Survey
/// of Efficient Representations for Independent Unit Vectors", J. Computer Graphics Techniques 3(2), 2014). On each
/// cell, the map is linear in one or two triangles, and so is the dot product of a point and the direction. So a point
/// that another one beats at all corners of a cell is beaten in the whole cell. `side` is a power of two, at least 2.
/// `points` must not be empty.
pub(crate) fn candidates(points: &[[f64; 3]], side: usize) -> Vec<Vec<u32>> {
    let mut search = Search {
        points,
        side,
        lists: vec![Vec::new(); side * side],
        stack: (0..points.len() as u32).collect(),
        values: Vec::new(),
    };
    // A square across several octants would not be linear.
    let half = side / 2;
    for (row, column) in [(0, 0), (0, half), (half, 0), (half, half)] {
        search.divide(0, [row, column, half]);
    }
    search.lists
}

struct Search<'a> {
    points: &'a [[f64; 3]],
    side: usize,
    lists: Vec<Vec<u32>>,
    /// The candidates of the current square, after those of the squares that contain it.
    stack: Vec<u32>,
    /// Dot products of the candidates with the corners; kept to reuse its memory.
    values: Vec<[f64; 4]>,
}

impl Search<'_> {
    /// Keeps the points of `stack[start..]` that can be farthest within a square, and recurses into its quarters.
    fn divide(&mut self, start: usize, [row, column, size]: [usize; 3]) {
        let end = self.stack.len();
        if end - start == 1 {
            for r in row..row + size {
                for list in &mut self.lists[r * self.side + column..][..size] {
                    list.push(self.stack[start]);
                }
            }
            return;
        }
        self.keep(start, [row, column, size]);
        if size == 1 {
            self.lists[row * self.side + column] = self.stack[end..].to_vec();
        } else {
            let half = size / 2;
            for (r, c) in [(0, 0), (0, half), (half, 0), (half, half)] {
                self.divide(end, [row + r, column + c, half]);
            }
        }
        self.stack.truncate(end);
    }

    /// Pushes the points of `stack[start..]` that can be farthest within a square.
    fn keep(&mut self, start: usize, [row, column, size]: [usize; 3]) {
        let end = self.stack.len();
        let at = |i: usize| 2.0 * i as f64 / self.side as f64 - 1.0;
        let (u, v) = ([at(row), at(row + size)], [at(column), at(column + size)]);
        let corners = [
            direction(u[0], v[0]),
            direction(u[0], v[1]),
            direction(u[1], v[0]),
            direction(u[1], v[1]),
        ];
        // The farthest point at each corner, and for the sum of the corners.
        let mut best = [0; 5];
        let mut most = [f64::NEG_INFINITY; 5];
        self.values.clear();
        for i in start..end {
            let p = self.points[self.stack[i] as usize];
            let value = corners.map(|d| p[0] * d[0] + p[1] * d[1] + p[2] * d[2]);
            let mean = value[0] + value[1] + value[2] + value[3];
            for (k, x) in [value[0], value[1], value[2], value[3], mean].into_iter().enumerate() {
                if x > most[k] {
                    (best[k], most[k]) = (i - start, x);
                }
            }
            self.values.push(value);
        }
        let strongest = best.map(|b| self.values[b]);
        for (i, value) in self.values.iter().enumerate() {
            let beaten = || strongest.iter().any(|s| (0..4).all(|k| s[k] >= value[k]));
            if best.contains(&i) || !beaten() {
                self.stack.push(self.stack[start + i]);
            }
        }
    }
}

/// The direction (not normalized) for the point `u`, `v` of the map, each from -1 to 1.
fn direction(u: f64, v: f64) -> [f64; 3] {
    let z = 1.0 - u.abs() - v.abs();
    if z >= 0.0 { [u, v, z] } else { [(1.0 - v.abs()).copysign(u), (1.0 - u.abs()).copysign(v), z] }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// General directions, and directions with equal, zero and opposite coordinates, which are on the borders of cells.
    fn directions() -> Vec<[f64; 3]> {
        let mut list: Vec<[f64; 3]> = (0..4000)
            .map(|i| {
                let x = f64::from(i);
                [(1.3 * x).sin(), (2.1 * x).cos(), (0.7 * x).sin()]
            })
            .collect();
        for x in [-1.0, -0.5, -0.0, 0.0, 0.5, 1.0] {
            for y in [-1.0, -0.25, -0.0, 0.0, 0.5, 1.0] {
                list.extend([-1.0, -0.5, -0.0, 0.0, 0.5, 1.0].map(|z| [x, y, z]));
            }
        }
        list.retain(|d| d.iter().any(|x| *x != 0.0));
        list
    }

    fn most(points: &[[f64; 3]], d: [f64; 3]) -> f64 {
        points
            .iter()
            .map(|p| p[0] * d[0] + p[1] * d[1] + p[2] * d[2])
            .fold(f64::NEG_INFINITY, f64::max)
    }

    #[test]
    fn the_table_finds_the_farthest_vertex() {
        for n in [1, 2, 3, 5, 8, 30, 300, 3000] {
            // On a stretched sphere around the origin, with some groups of close vertices.
            let points: Vec<[f64; 3]> = (0..n)
                .flat_map(|i| {
                    let x = f64::from(i);
                    let z = (0.77 * x).sin();
                    let (r, near) = ((1.0 - z * z).sqrt(), 1e-3 * (5.1 * x).cos());
                    let p = [r * (x + near).cos(), 2.0 * r * (x + near).sin(), 0.3 * z];
                    [p, p.map(|x| -x)]
                })
                .collect();
            let shape = ConvexShape::of_points(&points).expect("a shape");
            for d in directions() {
                let p = shape.farthest(Level::new(), d.into()).into();
                let (found, most) = (most(&[p], d), most(&points, d));
                assert!(
                    (found - most).abs() < 1e-14,
                    "{n} points, direction {d:?}: {found} {most}"
                );
            }
        }
    }

    #[test]
    fn an_octahedron_has_one_candidate_away_from_the_planes_of_symmetry() {
        // The direction's largest coordinate determines the farthest vertex: +z in the middle of the map.
        let points = [
            [1.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
        ];
        let lists = candidates(&points, 16);
        assert_eq!(lists[7 * 16 + 7], [4]);
        // Row u from 0.875 to 1, column v from 0 to 0.125: x is largest.
        assert_eq!(lists[15 * 16 + 8], [0]);
        assert_eq!(lists[15 * 16 + 15], [5]);
        assert!(lists.iter().all(|list| !list.is_empty() && list.len() <= 3));
    }
}
