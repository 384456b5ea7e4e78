//! What the robots with loops are made of.

use serde_json::{Value, json};
use testkit::core::{Core, sampled_configuration};
use testkit::fixture::Fixture;
use testkit::robot::{Robot, joint, limit, link, origin};
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::{Axis, JointType};

pub const X: [f64; 3] = [1.0, 0.0, 0.0];
pub const Y: [f64; 3] = [0.0, 1.0, 0.0];
pub const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// A robot of one link.
pub fn robot(name: &str, root: &str) -> Robot {
    let mut robot = Robot::new(name);
    robot.urdf.links.push(link(root));
    robot
}

/// Adds a link and the joint that holds it, `NAME_joint`: revolute with limits, else continuous; `None` for a ball.
pub fn hinge(
    robot: &mut Robot,
    name: &str,
    parent: &str,
    at: ([f64; 3], [f64; 3]),
    axis: [f64; 3],
    limits: Option<[f64; 2]>,
) {
    let kind = if limits.is_some() { JointType::Revolute } else { JointType::Continuous };
    moved(robot, name, kind, parent, at, Some(axis));
    robot.joint_mut(&format!("{name}_joint")).limit =
        limits.and_then(|[lower, upper]| limit(lower, upper));
}

/// Adds a link and a joint of any kind.
pub fn moved(
    robot: &mut Robot,
    name: &str,
    kind: JointType,
    parent: &str,
    (xyz, rpy): ([f64; 3], [f64; 3]),
    axis: Option<[f64; 3]>,
) {
    robot.urdf.links.push(link(name));
    let mut joint = joint(&format!("{name}_joint"), kind, parent, name);
    joint.origin = origin(xyz, rpy);
    joint.axis = axis.map(|axis| Axis { xyz: Some(axis) });
    robot.urdf.joints.push(joint);
}

/// A frame that is not turned.
pub fn pose(position: [f64; 3]) -> Value {
    json!({ "position": position, "quaternion_wxyz": [1.0, 0.0, 0.0, 0.0] })
}

/// A loop between points of two links.
pub fn closing(robot: &Robot, name: &str, kind: &str, ends: [(&str, [f64; 3]); 2]) -> Value {
    let [(a, at_a), (b, at_b)] = ends;
    json!({
        "name": name, "kind": kind,
        "link_a_idx": robot.link_idx(a), "frame_a": pose(at_a),
        "link_b_idx": robot.link_idx(b), "frame_b": pose(at_b),
        "position_tolerance": 0.0, "rotation_tolerance": 0.0,
    })
}

/// A linear coupling.
pub fn coupling(name: &str, constant: f64, terms: &[(usize, f64)]) -> Value {
    let terms = terms
        .iter()
        .map(|(dof, factor)| json!({ "dof_idx": dof, "coefficients": [factor, 0.0, 0.0, 0.0] }));
    json!({ "name": name, "constant": constant, "terms": terms.collect::<Vec<_>>() })
}

/// A URDD of the class Core with loops. `closed` gives the closed configuration of what the independent DOFs are in one:
/// it may read no others. The reference is that of `start`; the samples are the first `samples` of 9.3.
pub fn core_with_loops(
    robot: &Robot,
    [loops, couplings]: [Vec<Value>; 2],
    independent: &[usize],
    closed: impl Fn(&[f64]) -> Option<Vec<f64>>,
    start: &[f64],
    samples: u32,
) -> Fixture {
    let core = Core::new(robot);
    let samples = (0..samples).map(|k| {
        json!({ "sample_idx": k, "configuration": closed(&sampled_configuration(robot, &core, k)) })
    });
    let document = json!({
        "loops": loops,
        "couplings": couplings,
        "independent_dof_idxs": independent,
        "reference_configuration": closed(start).expect("a closed configuration"),
        "closed_samples": samples.collect::<Vec<_>>(),
    });
    Fixture::core_with(robot, ModuleKind::Loops, document)
}

/// An angle from -pi to pi.
pub fn turn(angle: f64) -> f64 {
    angle.sin().atan2(angle.cos())
}
