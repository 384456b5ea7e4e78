//! Dot products of a list of vectors with several axes at once; one lane is one axis.
//!
//! Uses only operations with the same result on every instruction set (IEEE add, multiply, compare, select; never a
//! fused multiply-add), so that a box does not depend on the machine.

use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};
use nalgebra::Vector3;

/// Axes per batch.
pub const AXES: usize = 8;

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
pub fn reach(vectors: &[Vector3<f64>], axes: &Axes) -> [Each; 2] {
    reach_at(Level::new(), vectors, axes)
}

fn reach_at(level: Level, vectors: &[Vector3<f64>], axes: &Axes) -> [Each; 2] {
    dispatch!(level, simd => reach_in(simd, vectors, axes))
}

/// For each vector, the set of axes with a dot product greater than `limit`.
pub fn beyond(vectors: &[Vector3<f64>], axes: &Axes, limit: f64, found: &mut Vec<u8>) {
    beyond_at(Level::new(), vectors, axes, limit, found);
}

fn beyond_at(level: Level, vectors: &[Vector3<f64>], axes: &Axes, limit: f64, found: &mut Vec<u8>) {
    found.resize(vectors.len(), 0);
    dispatch!(level, simd => beyond_in(simd, vectors, axes, limit, found));
}

#[inline(always)]
fn load<S: Simd>(simd: S, axes: &Axes) -> [f64x8<S>; 3] {
    [
        f64x8::load_array_ref(simd, &axes.0[0]),
        f64x8::load_array_ref(simd, &axes.0[1]),
        f64x8::load_array_ref(simd, &axes.0[2]),
    ]
}

/// The dot products of the axes with a vector.
#[inline(always)]
fn along<S: Simd>(simd: S, [x, y, z]: [f64x8<S>; 3], v: &Vector3<f64>) -> f64x8<S> {
    x * f64x8::splat(simd, v.x) + y * f64x8::splat(simd, v.y) + z * f64x8::splat(simd, v.z)
}

#[inline(always)]
fn reach_in<S: Simd>(simd: S, vectors: &[Vector3<f64>], axes: &Axes) -> [Each; 2] {
    let axes = load(simd, axes);
    let mut low = f64x8::splat(simd, f64::INFINITY);
    let mut high = f64x8::splat(simd, f64::NEG_INFINITY);
    for v in vectors {
        let along = along(simd, axes, v);
        low = along.simd_lt(low).select(along, low);
        high = along.simd_gt(high).select(along, high);
    }
    [low.to_array(), high.to_array()]
}

#[inline(always)]
fn beyond_in<S: Simd>(
    simd: S,
    vectors: &[Vector3<f64>],
    axes: &Axes,
    limit: f64,
    found: &mut [u8],
) {
    let axes = load(simd, axes);
    let limit = f64x8::splat(simd, limit);
    for (v, found) in vectors.iter().zip(found) {
        *found = along(simd, axes, v).simd_gt(limit).to_bitmask() as u8;
    }
}

#[cfg(test)]
#[path = "tests/vectors.rs"]
mod tests;
