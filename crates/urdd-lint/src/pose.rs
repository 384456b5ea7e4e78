//! The poses of links in the default configuration: each joint at 0, or at the limit nearest to it.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::bodies::{Bodies, isometry};
use urdd_document::robot::{Joint, Robot};
use urdd_format::urdf::JointType;

/// How many mimic joints may follow one another.
const MAX_FOLLOWED: usize = 10;

/// The pose of each link in the root's frame.
pub fn at_default(robot: &Robot, bodies: &Bodies) -> Vec<Isometry3<f64>> {
    let mut poses = vec![Isometry3::identity(); robot.links.len()];
    for &link in &bodies.tree.order {
        if let (Some(joint), Some(parent)) =
            (bodies.tree.parent_joint[link], bodies.tree.parent_link[link])
        {
            let joint = &robot.joints[joint];
            poses[link] = poses[parent] * isometry(&joint.origin) * motion(robot, joint);
        }
    }
    poses
}

fn motion(robot: &Robot, joint: &Joint) -> Isometry3<f64> {
    let position = position(robot, joint, 0);
    let Some(axis) = Vector3::from(joint.axis).try_normalize(0.0) else {
        return Isometry3::identity();
    };
    match joint.joint_type {
        JointType::Prismatic => Translation3::from(axis * position).into(),
        JointType::Revolute | JointType::Continuous => {
            Isometry3::from_parts(Translation3::identity(), UnitQuaternion::new(axis * position))
        }
        _ => Isometry3::identity(),
    }
}

fn position(robot: &Robot, joint: &Joint, followed: usize) -> f64 {
    if let Some(mimic) = joint.mimic.as_ref().filter(|_| followed < MAX_FOLLOWED) {
        let driver = robot.joints.iter().find(|other| other.name == mimic.joint);
        let driver = driver.map_or(0.0, |driver| position(robot, driver, followed + 1));
        return mimic.multiplier * driver + mimic.offset;
    }
    let limit = joint
        .limit
        .filter(|_| matches!(joint.joint_type, JointType::Revolute | JointType::Prismatic));
    let Some(limit) = limit else { return 0.0 };
    let (lower, upper) = (limit.lower.unwrap_or(0.0), limit.upper.unwrap_or(0.0));
    if lower <= upper { 0.0_f64.clamp(lower, upper) } else { 0.0 }
}
