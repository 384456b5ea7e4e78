//! The farthest vertex in a direction, in constant time.
//!
//! The directions are divided into cells ([`candidates`]). Most cells list one to four vertices, so four dot products find
//! the farthest, however many vertices the shape has.

use fearless_simd::{Simd, f64x4, prelude::*, u64x4};

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
