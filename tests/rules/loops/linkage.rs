//! A parallelogram's coupler turns back by the angle of its crank, a gear turns by its ratio, and a floating joint is where
//! its numbers say.

use serde_json::json;
use testkit::core::{Core, sampled_configuration};
use testkit::fixture::Fixture;
use testkit::robot::{Robot, joint, limit, link, origin};
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::JointType;

use super::made::{Z, hinge, moved, pose};

/// The lengths of crank and rocker, and of coupler and ground, m.
const CRANK: f64 = 0.1;
const COUPLER: f64 = 0.3;

/// A parallelogram on a plate that is turned, and two gears that lift a cam.
fn linkage_robot() -> Robot {
    let mut robot = Robot::new("linkage");
    robot.urdf.links.extend([link("base"), link("plate")]);
    let mut plate = joint("plate_joint", JointType::Fixed, "base", "plate");
    plate.origin = origin([0.1, -0.2, 0.3], [0.1, 0.2, 0.3]);
    robot.urdf.joints.push(plate);
    let mut turned = |name: &str, parent: &str, at: [f64; 3], limits: Option<[f64; 2]>| {
        hinge(&mut robot, name, parent, (at, [0.0; 3]), Z, limits);
    };
    turned("crank", "plate", [0.0; 3], Some([-1.0, 1.2]));
    turned("coupler", "crank", [CRANK, 0.0, 0.0], None);
    turned("rocker", "plate", [COUPLER, 0.0, 0.0], Some([-2.0, 2.0]));
    turned("wheel_a", "base", [0.0, 0.5, 0.0], Some([-1.5, 1.5]));
    turned("wheel_b", "base", [0.0, 0.6, 0.0], None);
    let at = ([0.0, 0.7, 0.0], [0.0; 3]);
    moved(&mut robot, "lift", JointType::Prismatic, "base", at, Some(Z));
    robot.joint_mut("lift_joint").limit = limit(-1.0, 1.0);
    robot
}

/// What the linkage is at an angle of the crank and one of the first wheel.
fn linkage_at(crank: f64, wheel: f64) -> [f64; 6] {
    let gear = 0.25 - 2.0 * wheel;
    let cam = 0.01 + wheel * (0.02 + wheel * (0.003 + wheel * (0.0005 + wheel * 0.0001)));
    [crank, -crank, crank, wheel, gear, cam]
}

/// The base `loops`.
pub fn linkage() -> Fixture {
    let robot = linkage_robot();
    let core = Core::new(&robot);
    let sample = |k: u32| {
        let sampled = sampled_configuration(&robot, &core, k);
        linkage_at(sampled[0], sampled[3])
    };
    let document = json!({
        "loops": [{
            "name": "parallelogram", "kind": "Revolute",
            "link_a_idx": 3, "frame_a": pose([COUPLER, 0.0, 0.0]),
            "link_b_idx": 4, "frame_b": pose([CRANK, 0.0, 0.0]),
            "position_tolerance": 0.0, "rotation_tolerance": 0.0,
        }],
        "couplings": [
            { "name": "gear", "constant": -0.25, "terms": [
                { "dof_idx": 3, "coefficients": [2.0, 0.0, 0.0, 0.0] },
                { "dof_idx": 4, "coefficients": [1.0, 0.0, 0.0, 0.0] },
            ]},
            { "name": "cam", "constant": 0.01, "terms": [
                { "dof_idx": 3, "coefficients": [0.02, 0.003, 0.0005, 0.0001] },
                { "dof_idx": 5, "coefficients": [-1.0, 0.0, 0.0, 0.0] },
            ]},
        ],
        "independent_dof_idxs": [0, 3],
        "reference_configuration": linkage_at(0.5, 0.25),
        "closed_samples": [
            { "sample_idx": 0, "configuration": sample(0) },
            { "sample_idx": 1, "configuration": null },
            { "sample_idx": 2, "configuration": sample(2) },
        ],
    });
    Fixture::core_with(&robot, ModuleKind::Loops, document)
}

/// The base `loops_free`: a link on a floating joint, and one weld. Cases hold less of it.
pub fn free() -> Fixture {
    let mut robot = Robot::new("free");
    robot.urdf.links.push(link("base"));
    let at = ([0.0, 0.0, 0.5], [0.0; 3]);
    moved(&mut robot, "body", JointType::Floating, "base", at, Some(Z));
    let document = json!({
        "loops": [{
            "name": "held", "kind": "Fixed",
            "link_a_idx": 0, "frame_a": pose([0.0, 0.0, 0.75]),
            "link_b_idx": 1, "frame_b": pose([0.0; 3]),
            "position_tolerance": 0.0, "rotation_tolerance": 0.0,
        }],
        "couplings": [],
        "independent_dof_idxs": [],
        "reference_configuration": [0.0, 0.0, 0.25, 0.0, 0.0, 0.0],
        "closed_samples": [],
    });
    Fixture::core_with(&robot, ModuleKind::Loops, document)
}
