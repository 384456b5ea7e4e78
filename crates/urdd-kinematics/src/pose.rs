//! Poses: conversion between URDD and nalgebra, and homogeneous 4 x 4 matrices, in row-major order.

use nalgebra::{Isometry3, Matrix3, Quaternion, Rotation3, Translation3, UnitQuaternion};
use thiserror::Error;

use crate::rotation::{canonical, from_rpy};
use urdd_format::pose::Pose;

/// Tolerance for the length of unit quaternions and unit axes. It accepts a producer that writes seven digits, and
/// rejects one that does not normalise.
pub const UNIT_TOLERANCE: f64 = 1e-6;

/// Why a pose is not a rigid transform.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum PoseError {
    /// A component of the position is infinite or NaN.
    #[error("the position has a component that is not a finite number")]
    Position,
    /// The quaternion does not have length 1.
    #[error("not a unit quaternion: its length is {norm}")]
    NotUnit {
        /// Its length.
        norm: f64,
    },
}

/// Whether a length is that of a unit vector, within the tolerance; false for NaN.
pub(super) fn is_unit(norm: f64) -> bool {
    (norm - 1.0).abs() <= UNIT_TOLERANCE
}

/// Converts a URDD pose to a transform. The quaternion may have either sign. Its length must be within
/// [`UNIT_TOLERANCE`] of 1; it is normalised.
pub fn to_isometry(pose: &Pose) -> Result<Isometry3<f64>, PoseError> {
    if !pose.position.iter().all(|x| x.is_finite()) {
        return Err(PoseError::Position);
    }
    let [w, x, y, z] = pose.quaternion_wxyz;
    let quaternion = Quaternion::new(w, x, y, z);
    let norm = quaternion.norm();
    if !is_unit(norm) {
        return Err(PoseError::NotUnit { norm });
    }
    Ok(Isometry3::from_parts(
        Translation3::from(pose.position),
        UnitQuaternion::new_normalize(quaternion),
    ))
}

/// Converts a transform to a URDD pose, with a canonical quaternion (see [`canonical`]) and without negative zeros.
pub fn from_isometry(isometry: &Isometry3<f64>) -> Pose {
    let rotation = UnitQuaternion::new_normalize(*isometry.rotation.quaternion());
    let q = canonical(&rotation);
    Pose {
        position: isometry.translation.vector.map(|x| x + 0.0).into(),
        quaternion_wxyz: [q.w, q.i, q.j, q.k],
    }
}

/// Made of a position and of angles about the fixed axes x, y and z, in this order.
pub fn from_xyz_rpy(xyz: [f64; 3], rpy: [f64; 3]) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::from(xyz), from_rpy(rpy))
}

/// Writes a pose as the 16 numbers of its matrix.
pub fn write_matrix(pose: &Isometry3<f64>, out: &mut [f64]) {
    let rotation = pose.rotation.to_rotation_matrix();
    let (r, t) = (rotation.matrix(), &pose.translation.vector);
    let rows = [
        [r.m11, r.m12, r.m13, t.x],
        [r.m21, r.m22, r.m23, t.y],
        [r.m31, r.m32, r.m33, t.z],
        [0.0, 0.0, 0.0, 1.0],
    ];
    out[..16].copy_from_slice(rows.as_flattened());
}

/// The pose of a matrix of a rotation and a translation, without a check that it is.
pub fn unchecked_pose(matrix: &[f64]) -> Isometry3<f64> {
    let rotation = Matrix3::from_fn(|row, column| matrix[4 * row + column]);
    let rotation = Rotation3::from_matrix_unchecked(rotation);
    Isometry3::from_parts(
        Translation3::new(matrix[3], matrix[7], matrix[11]),
        UnitQuaternion::from_rotation_matrix(&rotation),
    )
}

/// The pose of a matrix; `None` if it is not one of a rotation and a translation, within [`UNIT_TOLERANCE`].
pub fn pose(matrix: &[f64]) -> Option<Isometry3<f64>> {
    let rotation = Matrix3::from_fn(|row, column| matrix[4 * row + column]);
    let near = |a: f64, b: f64| (a - b).abs() <= UNIT_TOLERANCE;
    let product = rotation.tr_mul(&rotation);
    let orthonormal = product.iter().zip(&Matrix3::identity()).all(|(a, b)| near(*a, *b));
    let last = matrix[12..16].iter().zip([0.0, 0.0, 0.0, 1.0]);
    let finite = matrix.iter().all(|value| value.is_finite());
    let is_pose = finite
        && orthonormal
        && rotation.determinant() > 0.0
        && last.into_iter().all(|(a, b)| near(*a, b));
    is_pose.then(|| unchecked_pose(matrix))
}
