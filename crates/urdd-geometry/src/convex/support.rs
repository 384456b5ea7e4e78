//! Support functions for all lanes at once.

use fearless_simd::{Level, Simd, dispatch, prelude::*};
use nalgebra::Vector3;

use super::support_table::SupportTable;
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
