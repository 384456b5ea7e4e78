//! Numbers of clause 5.6: when two values agree.

use std::f64::consts::PI;

use serde_json::json;
use urdd_format::urdf::{JointType, Mimic};
use urdd_validate::code::Code::*;

use super::{Number, Sides, most, number};
use crate::bounds::bound;
use crate::chain::turned;
use crate::dof::star;
use testkit::fixture::Fixture;
use testkit::robot::limit;

const CHAIN: &str = "chain_module";
const SAMPLES: &str = "kinematics_samples_module";

/// Adds to a number of a document.
pub fn add(f: &mut Fixture, module: &str, pointer: &str, by: f64) {
    let old = f.get(module, pointer).as_f64().expect("a number");
    f.set(module, pointer, json!(old + by));
}

/// A joint on a base, whose reach follows from its type and limits alone.
fn one_joint(joint_type: JointType, limits: Option<(f64, f64)>) -> Fixture {
    let mut robot = star(&[("j", joint_type)]);
    robot.joint_mut("j").limit = limits.and_then(|(lower, upper)| limit(lower, upper));
    Fixture::core(&robot)
}

/// A prismatic joint that follows a revolute one by 0.5, up to 0.5 m of the 3 m of its limits.
fn sliding_mimic() -> Fixture {
    let mut robot = star(&[("j", JointType::Prismatic), ("driver", JointType::Revolute)]);
    let follower = robot.joint_mut("j");
    follower.limit = limit(-3.0, 1.0);
    follower.mimic =
        Some(Mimic { joint: "driver".to_owned(), multiplier: Some(0.5), offset: None });
    Fixture::core(&robot)
}

fn move_origin(f: &mut Fixture, by: f64) {
    add(f, CHAIN, "/joints_in_chain/0/origin/position/2", by);
}

/// Clause 5.6.
pub fn numbers() -> Vec<Number> {
    let turn = |f: &mut Fixture, by: f64| {
        let (sin, cos) = (0.25 + by / 2.0).sin_cos();
        f.set(CHAIN, "/joints_in_chain/0/origin/quaternion_wxyz", json!([cos, sin, 0, 0]));
    };
    vec![
        number(
            "position",
            "5.6",
            "at most 1e-9 of the robot's *reach*",
            ("1e-9", 1e-9),
            vec![
                // Travel counts: the larger absolute limit of a prismatic joint.
                most(
                    CHN008,
                    || one_joint(JointType::Prismatic, Some((-3.0, 1.0))),
                    move_origin,
                    3e-9,
                ),
                // 1 m for a planar joint.
                most(CHN008, || one_joint(JointType::Planar, None), move_origin, 1e-9),
                // Of a mimic joint its own limits, wherever its driver takes it.
                most(CHN008, sliding_mimic, move_origin, 3e-9),
                most(
                    KIN003,
                    || one_joint(JointType::Prismatic, Some((-3.0, 1.0))),
                    |f, by| add(f, SAMPLES, "/samples/0/link_poses/1/position/2", by),
                    3e-9,
                ),
            ],
        ),
        number(
            "least-reach",
            "5.6",
            "at least 1 mm",
            ("1 mm", 1e-3),
            vec![most(
                CHN008,
                || one_joint(JointType::Revolute, Some((-1.0, 1.0))),
                move_origin,
                1e-12,
            )],
        ),
        number(
            "rotation",
            "5.6",
            "over sqrt 2 is at most 1e-9",
            ("1e-9", 1e-9),
            vec![
                most(CHN008, || turned([0.5, 0.0, 0.0]), turn, 1e-9),
                most(
                    KIN003,
                    Fixture::toy,
                    |f, by| {
                        let (sin, cos) = (by / 2.0).sin_cos();
                        f.set(
                            SAMPLES,
                            "/samples/0/link_poses/1/quaternion_wxyz",
                            json!([cos, 0, sin, 0]),
                        );
                    },
                    1e-9,
                ),
            ],
        ),
        number(
            "axis",
            "5.6",
            "Two unit axes agree when the length of their difference is at most 1e-9",
            ("1e-9", 1e-9),
            // This joint turns by 0.25 rad at most, so that its poses agree too.
            vec![most(
                CHN009,
                Fixture::toy,
                |f, by| add(f, CHAIN, "/joints_in_chain/12/axis/1", by),
                1e-9,
            )],
        ),
        number(
            "number",
            "5.6",
            "at most 1e-9 of the larger absolute value, or by at most 1e-12",
            ("1e-9", 1e-9),
            vec![
                most(BND003, Fixture::toy, |f, by| bound(f, 0, -2.5, 2.5 * (1.0 + by)), 1e-9),
                most(BND006, Fixture::toy, |f, by| bound(f, 15, -PI * (1.0 + by), PI), 1e-9),
                most(
                    BND005,
                    Fixture::toy,
                    |f, by| add(f, "bounds_module", "/dof_effort_limits/1", 10.0 * by),
                    1e-9,
                ),
                most(
                    SHP004,
                    crate::shapes::fits::lone_box,
                    |f, by| {
                        let list = "/full_obbs_maximum_distances/0";
                        let old = f.get(crate::shapes::REACH, list).as_f64().expect("a number");
                        f.set(crate::shapes::REACH, list, json!(old * (1.0 + by)));
                    },
                    1e-9,
                ),
                most(
                    URD013,
                    Fixture::toy,
                    |f, by| add(f, "urdf_module", "/links/1/inertial/mass/value", by),
                    1e-9,
                ),
            ],
        ),
        number(
            "small-number",
            "5.6",
            "or by at most 1e-12",
            ("1e-12", 1e-12),
            vec![most(BND003, Fixture::toy, |f, by| bound(f, 2, -by, 0.2), 1e-12)],
        ),
        number(
            "rotation-vector",
            "5.6",
            "not longer than pi times 1 + 1e-9",
            ("1e-9", 1e-9),
            vec![Sides::Elsewhere("of a billion sampled rotation vectors one is as long")],
        ),
        number(
            "configuration",
            "5.6",
            "also within 1e-9 of the larger absolute value of its DOF's bounds",
            ("1e-9", 1e-9),
            // The middle of [0, 0.2] is 0.1.
            vec![most(
                KIN002,
                Fixture::toy,
                |f, by| add(f, SAMPLES, "/samples/1/configuration/2", by),
                2e-10,
            )],
        ),
    ]
}
