//! Poses of a URDF as rigid motions, and back.

use nalgebra::{Isometry3, Rotation3, UnitQuaternion};

use urdd_document::robot::Origin as View;
use urdd_format::urdf::Origin;
use urdd_kinematics::rotation::to_rpy;

pub(super) fn motion(origin: &View) -> Isometry3<f64> {
    let rotation = Rotation3::from_matrix_unchecked(origin.rotation());
    let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
    Isometry3::from_parts(origin.xyz.into(), rotation)
}

pub(super) fn origin(pose: &Isometry3<f64>) -> Origin {
    Origin {
        xyz: Some(pose.translation.vector.into()),
        rpy: Some(to_rpy(pose.rotation.to_rotation_matrix().matrix())),
        quat_xyzw: None,
    }
}
