//! Conversion of poses between URDD and nalgebra.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use thiserror::Error;

use super::rotation::{canonical, from_rpy};
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
