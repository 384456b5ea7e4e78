//! The robot that a URDF describes: where its links are, and its mesh files.

use std::path::Path;

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use urdd_document::pose::unit;
use urdd_document::robot::{Joint, Origin, Robot, of_urdf};
use urdd_document::tree::Tree;
use urdd_format::urdf::JointType;
use urdd_source::{Settings, SourceMeshes};

/// How many mimics in a row are followed: more go in a circle.
const MOST_MIMICS: usize = 100;

/// A robot.
pub struct RobotModel {
    /// Its mesh files.
    pub source: SourceMeshes,
    /// Its links and joints, with URDF's defaults.
    pub robot: Robot,
    /// Its tree; `None` if the joints form none.
    pub tree: Option<Tree>,
    /// The pose of each link in the root link's frame, in the default configuration; empty without a tree.
    pub poses: Vec<Isometry3<f64>>,
}

impl RobotModel {
    /// The robot of a URDF; `None` if it describes none.
    pub fn new(text: &str, name: &str, folder: &Path, settings: &Settings) -> Option<Self> {
        let source = SourceMeshes::of_text(text, name, folder, settings).ok()?;
        let robot = of_urdf(&source.robot);
        let tree = Tree::new(&robot);
        let poses = tree.as_ref().map(|tree| poses(&robot, tree));
        Some(RobotModel { source, robot, tree, poses: poses.unwrap_or_default() })
    }
}

fn poses(robot: &Robot, tree: &Tree) -> Vec<Isometry3<f64>> {
    let mut poses = vec![Isometry3::identity(); robot.links.len()];
    for &link in &tree.order {
        let (Some(parent), Some(joint)) = (tree.parent_link[link], tree.parent_joint[link]) else {
            continue;
        };
        let joint = &robot.joints[joint];
        let motion = motion(joint, default_position(robot, joint, 0));
        poses[link] = poses[parent] * isometry(&joint.origin) * motion;
    }
    poses
}

fn isometry(origin: &Origin) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::from(origin.xyz), rotation(&origin.rotation()))
}

fn rotation(matrix: &Matrix3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*matrix))
}

/// The position in the default configuration: 0, or the limit nearest to it.
fn default_position(robot: &Robot, joint: &Joint, followed: usize) -> f64 {
    if let Some(mimic) = joint.active_mimic().filter(|_| followed < MOST_MIMICS) {
        let other = robot.joint(&mimic.joint).map(|index| &robot.joints[index]);
        let position = other.map_or(0.0, |other| default_position(robot, other, followed + 1));
        return mimic.multiplier * position + mimic.offset;
    }
    match joint.position_limits() {
        Some((a, b)) => 0.0_f64.max(a.min(b)).min(a.max(b)),
        None => 0.0,
    }
}

fn motion(joint: &Joint, position: f64) -> Isometry3<f64> {
    let axis = unit(joint.axis).unwrap_or_else(Vector3::zeros);
    match joint.joint_type {
        JointType::Revolute | JointType::Continuous => Isometry3::from_parts(
            Translation3::identity(),
            UnitQuaternion::from_scaled_axis(axis * position),
        ),
        JointType::Prismatic => {
            Isometry3::from_parts((axis * position).into(), UnitQuaternion::identity())
        }
        _ => Isometry3::identity(),
    }
}
