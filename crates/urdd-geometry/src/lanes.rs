//! Numbers and vectors of several samples at once: one lane is one sample, or a pair, an axis or a face.
//!
//! Uses only operations with the same result on every instruction set (IEEE add, subtract, multiply, divide, square
//! root, compare, select; never a fused multiply-add), so that a result does not depend on the machine's SIMD level.

use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use nalgebra::Isometry3;

/// Samples per batch.
pub(crate) const LANES: usize = 8;

/// A number for each lane.
pub(crate) type Num<S> = f64x8<S>;
/// A Boolean for each lane.
pub(crate) type Mask<S> = mask64x8<S>;

/// A three-dimensional vector for each lane.
#[derive(Clone, Copy)]
pub(crate) struct Vec3<S: Simd> {
    pub x: Num<S>,
    pub y: Num<S>,
    pub z: Num<S>,
}

#[inline(always)]
pub(crate) fn splat<S: Simd>(simd: S, value: f64) -> Num<S> {
    Num::splat(simd, value)
}

#[inline(always)]
pub(crate) fn select<S: Simd>(mask: Mask<S>, yes: Num<S>, no: Num<S>) -> Num<S> {
    mask.select(yes, no)
}

impl<S: Simd> Vec3<S> {
    #[inline(always)]
    pub fn splat(simd: S, v: [f64; 3]) -> Self {
        Self { x: splat(simd, v[0]), y: splat(simd, v[1]), z: splat(simd, v[2]) }
    }

    #[inline(always)]
    pub fn load(simd: S, [x, y, z]: [&[f64]; 3]) -> Self {
        Self {
            x: Num::from_slice(simd, x),
            y: Num::from_slice(simd, y),
            z: Num::from_slice(simd, z),
        }
    }

    #[inline(always)]
    pub fn lane(&self, lane: usize) -> [f64; 3] {
        [self.x[lane], self.y[lane], self.z[lane]]
    }

    #[inline(always)]
    pub fn dot(self, o: Self) -> Num<S> {
        self.x * o.x + self.y * o.y + self.z * o.z
    }

    #[inline(always)]
    pub fn cross(self, o: Self) -> Self {
        Self {
            x: self.y * o.z - self.z * o.y,
            y: self.z * o.x - self.x * o.z,
            z: self.x * o.y - self.y * o.x,
        }
    }

    #[inline(always)]
    pub fn scale(self, k: Num<S>) -> Self {
        Self { x: self.x * k, y: self.y * k, z: self.z * k }
    }

    #[inline(always)]
    pub fn select(mask: Mask<S>, yes: Self, no: Self) -> Self {
        Self {
            x: select(mask, yes.x, no.x),
            y: select(mask, yes.y, no.y),
            z: select(mask, yes.z, no.z),
        }
    }
}

impl<S: Simd> core::ops::Add for Vec3<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self { x: self.x + o.x, y: self.y + o.y, z: self.z + o.z }
    }
}

impl<S: Simd> core::ops::Sub for Vec3<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self { x: self.x - o.x, y: self.y - o.y, z: self.z - o.z }
    }
}

impl<S: Simd> core::ops::Neg for Vec3<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}

/// The columns of a pose's rotation, then its translation, metres.
pub fn columns(pose: &Isometry3<f64>) -> [[f64; 3]; 4] {
    let rotation = pose.rotation.to_rotation_matrix();
    let column = |k: usize| rotation.matrix().column(k).into_owned().into();
    let shift = pose.translation.vector.into();
    [column(0), column(1), column(2), shift]
}

/// A rotation and a translation for each lane; `columns` are the images of the axes.
#[derive(Clone, Copy)]
pub(crate) struct Pose<S: Simd> {
    pub columns: [Vec3<S>; 3],
    pub shift: Vec3<S>,
}

impl<S: Simd> Pose<S> {
    /// The same columns and translation in each lane.
    #[inline(always)]
    pub fn same(simd: S, pose: &[[f64; 3]; 4]) -> Self {
        Self {
            columns: [
                Vec3::splat(simd, pose[0]),
                Vec3::splat(simd, pose[1]),
                Vec3::splat(simd, pose[2]),
            ],
            shift: Vec3::splat(simd, pose[3]),
        }
    }

    /// The columns and translation of one lane.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> [[f64; 3]; 4] {
        [
            self.columns[0].lane(lane),
            self.columns[1].lane(lane),
            self.columns[2].lane(lane),
            self.shift.lane(lane),
        ]
    }

    /// R v.
    #[inline(always)]
    pub fn rotate(&self, v: Vec3<S>) -> Vec3<S> {
        self.columns[0].scale(v.x) + self.columns[1].scale(v.y) + self.columns[2].scale(v.z)
    }

    /// R^T v.
    #[inline(always)]
    pub fn rotate_back(&self, v: Vec3<S>) -> Vec3<S> {
        Vec3 { x: self.columns[0].dot(v), y: self.columns[1].dot(v), z: self.columns[2].dot(v) }
    }
}
