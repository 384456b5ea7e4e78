//! Simple forward kinematics for comparison: products of homogeneous 4x4 matrices, Rodrigues' formula, no quaternions.

use nalgebra::{Matrix3, Matrix4, Vector3};
use urdd_format::urdf::JointType;

use testkit::core_modules::{Joint, dof_count, first_dofs, unit};

/// Rotation by `angle` about the unit vector `axis`.
fn rodrigues(axis: Vector3<f64>, angle: f64) -> Matrix3<f64> {
    let k = axis.cross_matrix();
    Matrix3::identity() + k * angle.sin() + k * k * (1.0 - angle.cos())
}

fn rotation_vector(v: Vector3<f64>) -> Matrix3<f64> {
    if v.norm() == 0.0 { Matrix3::identity() } else { rodrigues(v.normalize(), v.norm()) }
}

/// Rz(yaw) Ry(pitch) Rx(roll).
pub fn rpy([roll, pitch, yaw]: [f64; 3]) -> Matrix3<f64> {
    rodrigues(Vector3::z(), yaw) * rodrigues(Vector3::y(), pitch) * rodrigues(Vector3::x(), roll)
}

/// The shortest arc from z to `axis`; from z to -z through -y.
fn arc(axis: Vector3<f64>) -> Matrix3<f64> {
    let about = Vector3::z().cross(&axis);
    let about = if about.norm() == 0.0 { Vector3::x() } else { about.normalize() };
    rodrigues(about, axis.x.hypot(axis.y).atan2(axis.z))
}

fn homogeneous(rotation: Matrix3<f64>, position: Vector3<f64>) -> Matrix4<f64> {
    rotation.to_homogeneous().append_translation(&position)
}

fn motion(joint: &Joint, q: &[f64]) -> Matrix4<f64> {
    let axis = Vector3::from(unit(joint.axis));
    let (still, unturned) = (Vector3::zeros(), Matrix3::identity());
    let vector = |from: usize| Vector3::new(q[from], q[from + 1], q[from + 2]);
    match joint.joint_type {
        JointType::Fixed => Matrix4::identity(),
        JointType::Revolute | JointType::Continuous => homogeneous(rodrigues(axis, q[0]), still),
        JointType::Prismatic => homogeneous(unturned, axis * q[0]),
        JointType::Planar => {
            let slide = homogeneous(unturned, arc(axis) * Vector3::new(q[0], q[1], 0.0));
            slide * homogeneous(rodrigues(axis, q[2]), still)
        }
        JointType::Floating => homogeneous(rotation_vector(vector(3)), vector(0)),
        JointType::Spherical => homogeneous(rotation_vector(vector(0)), still),
    }
}

/// The pose of link `link`, by recursion up to the root.
pub fn link_pose(joints: &[Joint], q: &[f64], link: usize) -> Matrix4<f64> {
    let Some(idx) = joints.iter().position(|joint| joint.child == link) else {
        return Matrix4::identity();
    };
    let joint = &joints[idx];
    let first = first_dofs(joints)[idx] as usize;
    let value = match &joint.mimic {
        Some(mimic) => {
            let driver = mimic.dof_idx.map_or(0.0, |dof| q[dof.get()]);
            vec![mimic.multiplier * driver + mimic.offset]
        }
        None => q[first..first + dof_count(joint) as usize].to_vec(),
    };
    let origin = homogeneous(rpy(joint.rpy), Vector3::from(joint.xyz));
    link_pose(joints, q, joint.parent) * origin * motion(joint, &value)
}
