//! CHN. Links of the toy: 0 finger_left, 1 base (the root), 2 turret, 3 arm, …; joint 1 (turn) leads
//! from 1 to 2, joint 2 (shoulder) from 2 to 3, joint 3 (flange) is fixed.

use std::f64::consts::{PI, TAU};

use serde_json::json;
use urdd_format::urdf::{Axis, JointType, Origin};
use urdd_validate::code::Code::*;

use super::dof::star;
use crate::{Case, changed, invalid, near_miss};
use testkit::fixture::Fixture;
use testkit::robot::{Robot, limit};

const CHAIN: &str = "chain_module";

fn nudge(fixture: &mut Fixture, pointer: &str, by: f64) {
    let old = fixture.get(CHAIN, pointer).as_f64().expect("a number");
    fixture.set(CHAIN, pointer, json!(old + by));
}

fn negate(fixture: &mut Fixture, pointer: &str) {
    let numbers = fixture.get(CHAIN, pointer).as_array().expect("a list");
    let numbers: Vec<f64> = numbers.iter().map(|x| -x.as_f64().expect("a number")).collect();
    fixture.set(CHAIN, pointer, json!(numbers));
}

/// A robot of two links, connected by a joint with this rotation.
pub fn turned(rpy: [f64; 3]) -> Fixture {
    let mut robot = star(&[("j", JointType::Continuous)]);
    robot.joint_mut("j").origin = Some(Origin { xyz: None, rpy: Some(rpy), quat_xyzw: None });
    Fixture::core(&robot)
}

/// The same, with a quaternion in a URDF of this version.
fn turned_by(version: &'static str, xyzw: [f64; 4]) -> Fixture {
    let mut robot = star(&[("j", JointType::Continuous)]);
    robot.urdf.version = Some(version.to_owned());
    robot.joint_mut("j").origin = Some(Origin { xyz: None, rpy: None, quat_xyzw: Some(xyzw) });
    Fixture::core(&robot)
}

/// A chain, and thus samples, with `quat_xyzw` for a joint.
fn quaternion(
    name: &'static str,
    caught: bool,
    version: &'static str,
    xyzw: [f64; 4],
    wxyz: [f64; 4],
) -> Case {
    let base = move || turned_by(version, xyzw);
    changed(CHN008, name, caught, base, move |fixture| {
        fixture.set(CHAIN, "/joints_in_chain/0/origin/quaternion_wxyz", json!(wxyz));
    })
}

pub fn cases() -> Vec<Case> {
    let valid = |code, name, robot: fn() -> Robot| {
        changed(code, name, false, move || Fixture::core(&robot()), |_| {})
    };
    let mut cases = tables(valid);
    cases.extend(motions(valid));
    cases
}

fn tables(
    valid: impl Fn(urdd_validate::code::Code, &'static str, fn() -> Robot) -> Case,
) -> Vec<Case> {
    vec![
        invalid(CHN001, "link-left-out", |f| {
            f.remove(CHAIN, "/links_in_chain/3");
        }),
        invalid(CHN001, "name-of-another-case", |f| {
            f.set(CHAIN, "/links_in_chain/3/name", json!("Arm"));
        }),
        invalid(CHN001, "index-from-one", |f| {
            f.set(CHAIN, "/links_in_chain/3/link_idx", json!(4));
        }),
        valid(CHN001, "names-that-differ-in-case", || {
            star(&[("a", JointType::Fixed), ("A", JointType::Fixed)])
        }),
        invalid(CHN002, "joint-left-out", |f| {
            f.remove(CHAIN, "/joints_in_chain/13");
        }),
        invalid(CHN002, "parent-of-another", |f| {
            f.set(CHAIN, "/joints_in_chain/2/parent_link_idx", json!(1));
        }),
        invalid(CHN002, "child-out-of-range", |f| {
            f.set(CHAIN, "/joints_in_chain/2/child_link_idx", json!(15));
        }),
        invalid(CHN002, "name-without-its-accent", |f| {
            f.set(CHAIN, "/joints_in_chain/7/joint_name", json!("socket/u"));
        }),
        valid(CHN002, "joint-named-as-a-link", || star(&[("base", JointType::Revolute)])),
        invalid(CHN003, "second-root", |f| {
            f.set(CHAIN, "/links_in_chain/3/parent_link_idx", json!(null));
        }),
        invalid(CHN003, "parent-joint-of-another", |f| {
            f.set(CHAIN, "/links_in_chain/3/parent_joint_idx", json!(1));
        }),
        invalid(CHN003, "root-with-a-parent", |f| {
            f.set(CHAIN, "/links_in_chain/1/parent_link_idx", json!(1));
        }),
        valid(CHN003, "link-alone", || star(&[])),
        invalid(CHN004, "child-left-out", |f| {
            f.remove(CHAIN, "/links_in_chain/1/children_joint_idxs/0");
        }),
        invalid(CHN004, "children-descend", |f| {
            let links = f.doc_mut(CHAIN).pointer_mut("/links_in_chain/1/children_link_idxs");
            links.and_then(|l| l.as_array_mut()).expect("a list").reverse();
        }),
        valid(CHN004, "joints-and-links-in-different-orders", || {
            let mut robot = star(&[("a", JointType::Revolute), ("b", JointType::Revolute)]);
            robot.urdf.links.reverse();
            robot
        }),
        invalid(CHN005, "link-on-the-level-above", |f| {
            let link = f.remove(CHAIN, "/kinematic_hierarchy/2/0");
            f.set(CHAIN, "/kinematic_hierarchy/1/-", link);
        }),
        invalid(CHN005, "level-missing", |f| {
            f.remove(CHAIN, "/kinematic_hierarchy/3");
        }),
        invalid(CHN005, "another-link-on-the-deepest-level", |f| {
            f.set(CHAIN, "/kinematic_hierarchy/6/0", json!(7));
        }),
        invalid(CHN005, "level-descends", |f| {
            let level = f.doc_mut(CHAIN).pointer_mut("/kinematic_hierarchy/1");
            level.and_then(|l| l.as_array_mut()).expect("a list").reverse();
        }),
        valid(CHN005, "one-level", || star(&[])),
        invalid(CHN006, "first-link-for-root", |f| f.set(CHAIN, "/root_idx", json!(0))),
        invalid(CHN006, "root-out-of-range", |f| f.set(CHAIN, "/root_idx", json!(15))),
        valid(CHN006, "root-is-the-last-link", || {
            let mut robot = star(&[("a", JointType::Revolute)]);
            robot.urdf.links.reverse();
            robot
        }),
    ]
}

fn motions(
    valid: impl Fn(urdd_validate::code::Code, &'static str, fn() -> Robot) -> Case,
) -> Vec<Case> {
    const QUATERNION: &str = "/joints_in_chain/2/origin/quaternion_wxyz";
    vec![
        invalid(CHN007, "continuous-for-revolute", |f| {
            f.set(CHAIN, "/joints_in_chain/1/joint_type", json!("Continuous"));
        }),
        valid(CHN007, "continuous-with-limits", || {
            let mut robot = star(&[("j", JointType::Continuous)]);
            robot.joint_mut("j").limit = limit(-1.0, 1.0);
            robot
        }),
        quaternion(
            "quaternion-taken-for-w-first",
            true,
            "1.1",
            [0.8, 0.0, 0.0, 0.6],
            [0.8, 0.0, 0.0, 0.6],
        ),
        quaternion(
            "quaternion-passed-over",
            true,
            "1.2",
            [0.8, 0.0, 0.0, 0.6],
            [1.0, 0.0, 0.0, 0.0],
        ),
        quaternion(
            "quaternion-before-1.1",
            true,
            "1.0",
            [0.8, 0.0, 0.0, 0.6],
            [0.6, 0.8, 0.0, 0.0],
        ),
        quaternion(
            "quaternion-of-any-length",
            false,
            "1.1",
            [-2.4, 0.0, 0.0, -1.8],
            [0.6, 0.8, 0.0, 0.0],
        ),
        quaternion(
            "quaternion-without-meaning",
            false,
            "1.0",
            [0.8, 0.0, 0.0, 0.6],
            [1.0, 0.0, 0.0, 0.0],
        ),
        quaternion("quaternion-without-length", false, "1.1", [0.0; 4], [1.0, 0.0, 0.0, 0.0]),
        invalid(CHN008, "moved-by-a-thousandth", |f| {
            nudge(f, "/joints_in_chain/2/origin/position/2", 1e-3);
        }),
        invalid(CHN008, "rounded-to-32-bits", |f| {
            f.set(CHAIN, "/joints_in_chain/2/origin/position/2", json!(f64::from(0.2_f32)));
        }),
        invalid(CHN008, "inverse-rotation", |f| {
            for part in 1..4 {
                let pointer = format!("{QUATERNION}/{part}");
                let old = f.get(CHAIN, &pointer).as_f64().expect("a number");
                f.set(CHAIN, &pointer, json!(-old));
            }
        }),
        // Its first number is negative, and negating all four would not help.
        changed(
            CHN008,
            "quaternion-with-w-last",
            true,
            || turned([-0.5, 0.0, 0.0]),
            |f| {
                let pointer = "/joints_in_chain/0/origin/quaternion_wxyz";
                let (sin, cos) = 0.25_f64.sin_cos();
                f.set(CHAIN, pointer, json!([-sin, 0.0, 0.0, cos]));
            },
        ),
        near_miss(CHN008, "moved-by-rounding", |f| {
            nudge(f, "/joints_in_chain/2/origin/position/2", 1e-12);
            nudge(f, &format!("{QUATERNION}/1"), 1e-13);
        }),
        changed(
            CHN008,
            "half-a-turn-without-rounding",
            false,
            || turned([PI, 0.0, 0.0]),
            |f| {
                let pointer = "/joints_in_chain/0/origin/quaternion_wxyz";
                f.set(CHAIN, pointer, json!([0.0, 1.0, 0.0, 0.0]));
            },
        ),
        changed(
            CHN008,
            "whole-turn",
            false,
            || turned([0.0, 0.0, TAU]),
            |f| {
                let pointer = "/joints_in_chain/0/origin/quaternion_wxyz";
                f.set(CHAIN, pointer, json!([1.0, 0.0, 0.0, 0.0]));
            },
        ),
        invalid(CHN009, "not-divided-by-its-length", |f| {
            f.set(CHAIN, "/joints_in_chain/1/axis", json!([0.0, 0.0, 2.0]));
        }),
        invalid(CHN009, "reversed", |f| negate(f, "/joints_in_chain/2/axis")),
        invalid(CHN009, "axis-of-a-fixed-joint", |f| {
            f.set(CHAIN, "/joints_in_chain/3/axis", json!([1.0, 0.0, 0.0]));
        }),
        invalid(CHN009, "axis-left-out", |f| {
            f.set(CHAIN, "/joints_in_chain/4/axis", json!(null));
        }),
        near_miss(CHN009, "rounded", |f| {
            nudge(f, "/joints_in_chain/2/axis/0", 1e-11);
        }),
        valid(CHN009, "tiny-axis-and-axis-of-a-fixed-joint", || {
            let mut robot = star(&[("a", JointType::Revolute), ("b", JointType::Fixed)]);
            let axis = |xyz| Some(Axis { xyz: Some(xyz) });
            robot.joint_mut("a").axis = axis([0.0, 3e-100, 4e-100]);
            robot.joint_mut("b").axis = axis([0.0, 0.0, 0.0]);
            robot
        }),
        invalid(CHN010, "negative", |f| negate(f, QUATERNION)),
        invalid(CHN010, "too-long", |f| {
            f.set(CHAIN, QUATERNION, json!([2.0, 0.0, 0.0, 0.0]));
        }),
        invalid(CHN010, "zero", |f| {
            f.set(CHAIN, QUATERNION, json!([0.0, 0.0, 0.0, 0.0]));
        }),
        changed(
            CHN010,
            "half-a-turn-about-minus-x",
            true,
            || turned([PI, 0.0, 0.0]),
            |f| {
                let pointer = "/joints_in_chain/0/origin/quaternion_wxyz";
                f.set(CHAIN, pointer, json!([0.0, -1.0, 0.0, 0.0]));
            },
        ),
        changed(
            CHN010,
            "length-off-by-rounding",
            false,
            || turned([0.0; 3]),
            |f| {
                let pointer = "/joints_in_chain/0/origin/quaternion_wxyz";
                f.set(CHAIN, pointer, json!([1.000_000_000_1, 0.0, 0.0, 0.0]));
            },
        ),
    ]
}
