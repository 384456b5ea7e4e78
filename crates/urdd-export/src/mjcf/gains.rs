//! The inertia that a joint moves, from which the gains of its actuator are computed.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Vector3};

use super::super::error::ExportError;
use super::super::subject::Subject;
use urdd_document::robot::{Inertial, Joint};
use urdd_format::urdf::JointType;
use urdd_kinematics::rotation::unit_axis;

/// Number of sampled configurations (SPEC 9.3) in which inertias are computed, besides the default one.
const SAMPLES: u64 = 32;

/// For each joint that an actuator drives, the inertia about or along its axis: the diagonal entry of the mass
/// matrix, kg m² or kg, the greatest over the default configuration and [`SAMPLES`] others. Joints that follow it count
/// with the square of their factor. The other joints do not move.
pub(super) fn inertias(subject: &Subject) -> Result<Vec<Option<f64>>, ExportError> {
    let space = subject.robot.configurations()?;
    let joints = 0..subject.view.joints.len();
    let mut most: Vec<Option<f64>> =
        joints.map(|joint| subject.is_actuated(joint).then_some(0.0)).collect();
    let configurations = (0..SAMPLES).map(|k| space.random(k));
    for configuration in [space.zero()].into_iter().chain(configurations) {
        let poses = subject.robot.link_poses(&configuration)?;
        let mut now = vec![0.0; most.len()];
        for (index, joint) in subject.view.joints.iter().enumerate() {
            if joint.num_dofs() != 1 {
                continue;
            }
            let own = moved(subject, index, joint, &poses);
            match &subject.mimics.by_joint[index] {
                Some(mimic) => now[mimic.driver] += mimic.multiplier * mimic.multiplier * own,
                None => now[index] += own,
            }
        }
        for (most, now) in most.iter_mut().zip(now) {
            *most = most.map(|most| most.max(now));
        }
    }
    Ok(most)
}

/// What a joint moves: the inertia of all links after it about its axis, or their mass.
fn moved(subject: &Subject, index: usize, joint: &Joint, poses: &[Isometry3<f64>]) -> f64 {
    let child = subject.tree.joint_links[index].1;
    let Some(axis) = unit_axis(joint.axis) else {
        return 0.0;
    };
    let axis = poses[child].rotation * axis.into_inner();
    let origin = poses[child].translation.vector;
    let mut links = vec![child];
    let mut sum = 0.0;
    while let Some(link) = links.pop() {
        let children = subject.tree.child_joints[link].iter();
        links.extend(children.map(|joint| subject.tree.joint_links[*joint].1));
        let Some(inertial) = &subject.view.links[link].inertial else {
            continue;
        };
        let mass = inertial.mass.unwrap_or(0.0).max(0.0);
        sum += match joint.joint_type {
            JointType::Prismatic => mass,
            _ => about(inertial, mass, &poses[link], axis, origin),
        };
    }
    sum
}

/// The inertia of a link about an axis through `origin`, kg m².
fn about(
    inertial: &Inertial,
    mass: f64,
    pose: &Isometry3<f64>,
    axis: Vector3<f64>,
    origin: Vector3<f64>,
) -> f64 {
    let [xx, xy, xz, yy, yz, zz] = inertial.inertia.unwrap_or_default();
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let turned = pose.rotation * Rotation3::from_matrix_unchecked(inertial.origin.rotation());
    let own = turned.inverse() * axis;
    let centre = pose * Point3::from(inertial.origin.xyz);
    let arm = axis.cross(&(centre.coords - origin));
    // An inertia that is not positive is left out, as in the file.
    own.dot(&(tensor * own)).max(0.0) + mass * arm.norm_squared()
}
