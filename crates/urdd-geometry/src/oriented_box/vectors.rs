//! Dot products of a list of vectors with several axes at once; one lane is one axis. A box does not depend on the
//! machine (`lanes`).

use fearless_simd::{Level, Simd, dispatch, prelude::*};
use nalgebra::Vector3;

pub(super) use crate::lanes::LANES as AXES;
use crate::lanes::{Vec3, splat};

/// The x, y and z coordinates of the axes.
pub struct Axes([[f64; AXES]; 3]);

impl Axes {
    /// From 1 to [`AXES`] axes; the first axis fills unused lanes.
    pub fn new(axes: &[Vector3<f64>]) -> Self {
        let of = |k: usize| std::array::from_fn(|a| axes.get(a).unwrap_or(&axes[0])[k]);
        Self([of(0), of(1), of(2)])
    }
}

/// One number for each axis.
pub type Each = [f64; AXES];

/// The minimum and maximum dot product of each axis with the vectors.
pub fn reach(level: Level, vectors: &[Vector3<f64>], axes: &Axes) -> [Each; 2] {
    dispatch!(level, simd => reach_in(simd, vectors, axes))
}

/// For each vector, the set of axes with a dot product greater than `limit`.
pub fn beyond(
    level: Level,
    vectors: &[Vector3<f64>],
    axes: &Axes,
    limit: f64,
    found: &mut Vec<u8>,
) {
    found.resize(vectors.len(), 0);
    dispatch!(level, simd => beyond_in(simd, vectors, axes, limit, found));
}

#[inline(always)]
fn reach_in<S: Simd>(simd: S, vectors: &[Vector3<f64>], Axes([x, y, z]): &Axes) -> [Each; 2] {
    let axes = Vec3::load(simd, [x, y, z]);
    let mut low = splat(simd, f64::INFINITY);
    let mut high = splat(simd, f64::NEG_INFINITY);
    for v in vectors {
        let along = axes.dot(Vec3::splat(simd, (*v).into()));
        low = along.simd_lt(low).select(along, low);
        high = along.simd_gt(high).select(along, high);
    }
    [low.to_array(), high.to_array()]
}

#[inline(always)]
fn beyond_in<S: Simd>(
    simd: S,
    vectors: &[Vector3<f64>],
    Axes([x, y, z]): &Axes,
    limit: f64,
    found: &mut [u8],
) {
    let axes = Vec3::load(simd, [x, y, z]);
    let limit = splat(simd, limit);
    for (v, found) in vectors.iter().zip(found) {
        let along = axes.dot(Vec3::splat(simd, (*v).into()));
        *found = along.simd_gt(limit).to_bitmask() as u8;
    }
}

#[cfg(test)]
#[path = "tests/vectors.rs"]
mod tests;
