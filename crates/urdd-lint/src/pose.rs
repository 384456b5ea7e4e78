//! Masses and inertias of links, and their poses: in the default configuration, each joint at 0 or at the limit nearest to it, and
//! in sampled ones.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};
use urdd_document::pose::unit;
use urdd_document::robot::{Joint, Link, Robot};
use urdd_document::tree::Tree;
use urdd_format::urdf::JointType;

/// The mass that a link states, kg.
pub fn mass(link: &Link) -> Option<f64> {
    link.inertial.as_ref()?.mass
}

/// The mass properties of a link, in the link's frame. The mass is above 0, and all numbers are finite.
#[derive(Debug, Clone, Copy)]
pub struct Inertial {
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass, m.
    pub center: Vector3<f64>,
    /// Principal moments about the centre of mass, kg m².
    pub moments: Vector3<f64>,
    /// The axis of each moment, as columns.
    pub axes: Matrix3<f64>,
}

impl Inertial {
    /// Those of a link; `None` if it has none, or no mass above 0.
    pub fn of(link: &Link) -> Option<Inertial> {
        let inertial = link.inertial.as_ref()?;
        let mass = inertial.mass.filter(|mass| *mass > 0.0 && mass.is_finite())?;
        let [xx, xy, xz, yy, yz, zz] = inertial.inertia?;
        let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let center = Vector3::from(inertial.origin.xyz);
        let size = tensor.abs().max();
        if !size.is_finite() || !center.iter().all(|x| x.is_finite()) {
            return None;
        }
        // Scaled to 1: squares of numbers near the ends of binary64 would overflow or underflow.
        let scale = if size > 0.0 { size } else { 1.0 };
        let eigen = (tensor / scale).symmetric_eigen();
        Some(Inertial {
            mass,
            center,
            moments: eigen.eigenvalues * scale,
            axes: inertial.origin.rotation() * eigen.eigenvectors,
        })
    }

    /// The sum of the principal moments, kg m².
    pub fn trace(&self) -> f64 {
        self.moments.sum()
    }
}

/// How many mimic joints may follow one another.
const MAX_FOLLOWED: usize = 100;

/// The pose of each link in the root's frame.
pub fn at_default(robot: &Robot, tree: &Tree) -> Vec<Isometry3<f64>> {
    let mut poses = vec![Isometry3::identity(); robot.links.len()];
    for &link in &tree.order {
        if let (Some(joint), Some(parent)) = (tree.parent_joint[link], tree.parent_link[link]) {
            poses[link] = poses[parent] * step(robot, joint, &default_of);
        }
    }
    poses
}

/// The pose of a link in sample `k`, in the root's frame: joints of one degree of freedom are within their limits, others
/// as by default.
pub fn sampled(robot: &Robot, tree: &Tree, link: usize, k: u64) -> Isometry3<f64> {
    let position = |joint: &Joint| {
        let turns = joint.joint_type == JointType::Continuous;
        let limits = joint.position_limits();
        let (lower, upper) = limits.unwrap_or(if turns { (-PI, PI) } else { (0.0, 0.0) });
        let u = urdd_kinematics::unit(k, robot.joint(&joint.name).unwrap_or_default() as u64);
        lower * (1.0 - u) + upper * u
    };
    let up = above(tree, link);
    up.fold(Isometry3::identity(), |below, joint| step(robot, joint, &position) * below)
}

/// The joints from a link up to the root. In a circle of joints, each once.
pub fn above(tree: &Tree, link: usize) -> impl Iterator<Item = usize> {
    let links = std::iter::successors(Some(link), move |link| tree.parent_link[*link]);
    links.map_while(move |link| tree.parent_joint[link]).take(tree.parent_joint.len())
}

/// The pose of a joint's child in its parent. `position` is that of each joint that follows no other.
fn step(robot: &Robot, joint: usize, position: &dyn Fn(&Joint) -> f64) -> Isometry3<f64> {
    let joint = &robot.joints[joint];
    joint.origin.motion() * motion(joint, followed(robot, joint, position, 0))
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
    followed(robot, joint, &default_of, 0)
}

/// The position of a joint, or what follows for it from the joint that it mimics.
fn followed(robot: &Robot, joint: &Joint, position: &dyn Fn(&Joint) -> f64, depth: usize) -> f64 {
    match joint.active_mimic().filter(|_| depth < MAX_FOLLOWED) {
        None => position(joint),
        Some(mimic) => {
            let driver = robot.joint(&mimic.joint).map(|driver| &robot.joints[driver]);
            let driver = driver.map_or(0.0, |driver| followed(robot, driver, position, depth + 1));
            mimic.multiplier * driver + mimic.offset
        }
    }
}

fn default_of(joint: &Joint) -> f64 {
    let (lower, upper) = joint.position_limits().unwrap_or_default();
    0.0_f64.max(lower.min(upper)).min(lower.max(upper))
}
