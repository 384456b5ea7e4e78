//! Poses as a URDD writes them, and as nalgebra computes with them.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use thiserror::Error;

use super::rotation::canonical;
use urdd_format::pose::Pose;

/// How far from 1 the length of a quaternion or an axis may be before we refuse to compute with it:
/// wide enough for a producer that writes seven digits, far too narrow for one that forgot to
/// normalise.
pub const UNIT_TOLERANCE: f64 = 1e-6;

/// Numbers that are no rigid transform.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum PoseError {
    /// A component of the position is infinite, or none.
    #[error("the position has a component that is not a finite number")]
    Position,
    /// The quaternion is not of length 1.
    #[error("not a unit quaternion: its length is {norm}")]
    NotUnit {
        /// Its length.
        norm: f64,
    },
}

/// Whether a vector of this length passes for a unit vector; NaN does not.
pub(super) fn is_unit(norm: f64) -> bool {
    (norm - 1.0).abs() <= UNIT_TOLERANCE
}

/// The transform of a pose as it is written. The quaternion may have either sign; it is scaled to
/// length 1, and has to be within [`UNIT_TOLERANCE`] of it.
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

/// The pose as a URDD writes it: canonical quaternion (see [`canonical`]), no negative zero.
pub fn from_isometry(isometry: &Isometry3<f64>) -> Pose {
    let rotation = UnitQuaternion::new_normalize(*isometry.rotation.quaternion());
    let q = canonical(&rotation);
    Pose {
        position: isometry.translation.vector.map(|x| x + 0.0).into(),
        quaternion_wxyz: [q.w, q.i, q.j, q.k],
    }
}

/// Distance between the origins of two frames, metres.
pub fn position_distance(a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
    (a.translation.vector - b.translation.vector).norm()
}
