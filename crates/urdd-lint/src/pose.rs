//! The poses of links in the default configuration: each joint at 0, or at the limit nearest to it.

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
    let mut poses = vec![Isometry3::identity(); robot.links.len()];
    for &link in &tree.order {
        if let (Some(joint), Some(parent)) = (tree.parent_joint[link], tree.parent_link[link]) {
            let joint = &robot.joints[joint];
            poses[link] = poses[parent] * isometry(&joint.origin) * motion(robot, joint);
        }
    }
    poses
}

fn motion(robot: &Robot, joint: &Joint) -> Isometry3<f64> {
    let position = default_position(robot, joint);
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
    position(robot, joint, 0)
}

fn position(robot: &Robot, joint: &Joint, followed: usize) -> f64 {
    if let Some(mimic) = joint.active_mimic().filter(|_| followed < MAX_FOLLOWED) {
        let driver = robot.joint(&mimic.joint).map(|index| &robot.joints[index]);
        let driver = driver.map_or(0.0, |driver| position(robot, driver, followed + 1));
        return mimic.multiplier * driver + mimic.offset;
    }
    let (lower, upper) = joint.position_limits().unwrap_or_default();
    0.0_f64.max(lower.min(upper)).min(lower.max(upper))
}
