//! Rigid motions as origins of a URDF.

use nalgebra::Isometry3;

use urdd_format::urdf::Origin;
use urdd_kinematics::rotation::to_rpy;

pub(super) fn origin(pose: &Isometry3<f64>) -> Origin {
    Origin {
        xyz: Some(pose.translation.vector.into()),
        rpy: Some(to_rpy(pose.rotation.to_rotation_matrix().matrix())),
        quat_xyzw: None,
    }
}
