//! The poses of links in the default configuration, each joint at 0 or at the limit nearest to it, and in sampled ones.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::bodies::isometry;
use urdd_document::pose::unit;
use urdd_document::robot::{Joint, Robot};
use urdd_document::tree::Tree;
use urdd_format::urdf::JointType;

/// How many mimic joints may follow one another.
const MAX_FOLLOWED: usize = 100;

/// The pose of each link in the root's frame.
pub fn at_default(robot: &Robot, tree: &Tree) -> Vec<Isometry3<f64>> {
    poses(robot, tree, &|joint| default_of(&robot.joints[joint]))
}

/// The pose of each link in sample `k`: joints of one degree of freedom are within their limits, others as by default.
pub fn sampled(robot: &Robot, tree: &Tree, k: u64) -> Vec<Isometry3<f64>> {
    poses(robot, tree, &|joint| {
        let turns = robot.joints[joint].joint_type == JointType::Continuous;
        let limits = robot.joints[joint].position_limits();
        let (lower, upper) = limits.unwrap_or(if turns { (-PI, PI) } else { (0.0, 0.0) });
        let u = urdd_kinematics::unit(k, joint as u64);
        lower * (1.0 - u) + upper * u
    })
}

/// `position` is that of each joint that follows no other, by its index.
fn poses(robot: &Robot, tree: &Tree, position: &dyn Fn(usize) -> f64) -> Vec<Isometry3<f64>> {
    let mut poses = vec![Isometry3::identity(); robot.links.len()];
    for &link in &tree.order {
        if let (Some(joint), Some(parent)) = (tree.parent_joint[link], tree.parent_link[link]) {
            let position = followed(robot, joint, position, 0);
            let joint = &robot.joints[joint];
            poses[link] = poses[parent] * isometry(&joint.origin) * motion(joint, position);
        }
    }
    poses
}

fn motion(joint: &Joint, position: f64) -> Isometry3<f64> {
    let axis = unit(joint.axis).unwrap_or_else(Vector3::zeros);
    match joint.joint_type {
        JointType::Prismatic => Translation3::from(axis * position).into(),
        JointType::Revolute | JointType::Continuous => {
            Isometry3::from_parts(Translation3::identity(), UnitQuaternion::new(axis * position))
        }
        _ => Isometry3::identity(),
    }
}

/// The position of a joint of one degree of freedom in the default configuration, rad or m.
pub fn default_position(robot: &Robot, joint: &Joint) -> f64 {
    let own = robot.joint(&joint.name);
    own.map_or(0.0, |own| followed(robot, own, &|joint| default_of(&robot.joints[joint]), 0))
}

/// The position of a joint, or what follows for it from the joint that it mimics.
fn followed(robot: &Robot, joint: usize, position: &dyn Fn(usize) -> f64, depth: usize) -> f64 {
    match robot.joints[joint].active_mimic().filter(|_| depth < MAX_FOLLOWED) {
        None => position(joint),
        Some(mimic) => {
            let driver = robot.joint(&mimic.joint);
            let driver = driver.map_or(0.0, |driver| followed(robot, driver, position, depth + 1));
            mimic.multiplier * driver + mimic.offset
        }
    }
}

fn default_of(joint: &Joint) -> f64 {
    let (lower, upper) = joint.position_limits().unwrap_or_default();
    0.0_f64.max(lower.min(upper)).min(lower.max(upper))
}
