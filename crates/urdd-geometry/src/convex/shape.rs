//! Convex shapes, and their support functions for all lanes at once.

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch};
use nalgebra::{Isometry3, Vector3};

use crate::convex::support_table::SupportTable;
use crate::lanes::{LANES, Num, Vec3, select, splat};
use crate::mesh::{Bounds, Mesh};
use crate::vector::sub;

/// The convex hull of points, prepared for distance queries.
#[derive(Clone, Debug)]
pub struct ConvexShape {
    /// Centre of the axis-aligned bounds, in the body frame.
    pub(crate) centre: [f64; 3],
    /// Half of the sizes of these bounds.
    half_extents: [f64; 3],
    /// Support table of the points relative to the centre.
    pub(crate) table: SupportTable,
}

/// A box, prepared for distance queries.
#[derive(Clone, Debug, PartialEq)]
pub struct OrientedBox {
    pub(crate) pose: Isometry3<f64>,
    pub(crate) half_extents: [f64; 3],
}

/// A sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    pub(crate) centre: [f64; 3],
    pub(crate) radius: f64,
}

/// Why a convex shape cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ShapeError {
    /// There are no vertices.
    #[error("the shape has no vertices; give at least one")]
    Empty,
    /// A vertex is not finite, or too far from the origin.
    #[error("vertex {vertex} is not finite, or farther than 1e9 m from the origin")]
    OutOfRange {
        /// Index of the vertex.
        vertex: usize,
    },
    /// The pose is not finite, or too far from the origin.
    #[error("the centre or the axes are not finite, or farther than 1e9 m from the origin")]
    Pose,
    /// A size is negative, too large or not finite.
    #[error("a half extent or radius is {size}; give one from 0 to 1e9 m")]
    Size {
        /// The half extent or radius, metres.
        size: f64,
    },
}

/// Maximum coordinate, metres. Fourth powers of much larger ones would overflow, and no robot is that large.
const FARTHEST: f64 = 1e9;

fn in_range(v: &[f64; 3]) -> bool {
    v.iter().all(|x| x.abs() <= FARTHEST)
}

impl ConvexShape {
    /// The convex hull of a mesh's vertices; ignores the triangles. A hull may be a polygon, a segment or a point.
    pub fn new(mesh: &Mesh) -> Result<Self, ShapeError> {
        Self::of_points(&mesh.vertices)
    }

    /// The convex hull of points, metres. Interior points only cost preparation time.
    pub fn of_points(points: &[[f64; 3]]) -> Result<Self, ShapeError> {
        if let Some(vertex) = points.iter().position(|p| !in_range(p)) {
            return Err(ShapeError::OutOfRange { vertex });
        }
        if points.is_empty() {
            return Err(ShapeError::Empty);
        }
        let Bounds { min, max } = Bounds::of(points.iter().copied());
        let centre: [f64; 3] = std::array::from_fn(|k| 0.5 * min[k] + 0.5 * max[k]);
        let points: Vec<[f64; 3]> = points.iter().map(|p| sub(*p, centre)).collect();
        let farthest = |most: f64, x: f64| most.max(x.abs());
        let half_extents = [0, 1, 2].map(|k| points.iter().map(|p| p[k]).fold(0.0, farthest));
        let table = SupportTable::new(&points);
        Ok(Self { centre, half_extents, table })
    }

    /// Centre of the axis-aligned bounds, in the body frame, metres.
    pub fn centre(&self) -> [f64; 3] {
        self.centre
    }

    /// Half of the sizes of the axis-aligned bounds, metres.
    pub fn half_extents(&self) -> [f64; 3] {
        self.half_extents
    }
}

impl OrientedBox {
    /// A box from the pose of its centre and axes in the body frame, and its half extents, metres.
    pub fn new(pose: Isometry3<f64>, half_extents: [f64; 3]) -> Result<Self, ShapeError> {
        let rotation = pose.rotation.coords;
        if !in_range(&pose.translation.vector.into()) || !rotation.iter().all(|x| x.is_finite()) {
            return Err(ShapeError::Pose);
        }
        match half_extents.into_iter().find(|h| !(0.0..=FARTHEST).contains(h)) {
            Some(size) => Err(ShapeError::Size { size }),
            None => Ok(Self { pose, half_extents }),
        }
    }
}

impl Sphere {
    /// A sphere from its centre in the body frame and its radius, metres.
    pub fn new(centre: Vector3<f64>, radius: f64) -> Result<Self, ShapeError> {
        let centre = centre.into();
        if !in_range(&centre) {
            Err(ShapeError::Pose)
        } else if !(0.0..=FARTHEST).contains(&radius) {
            Err(ShapeError::Size { size: radius })
        } else {
            Ok(Self { centre, radius })
        }
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convex::support_table::candidates;

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
