//! CHN: robots of other joints, and rotations.

use std::f64::consts::{PI, TAU};

use serde_json::json;
use urdd_format::urdf::{Axis, JointType, Origin};
use urdd_validate::code::Code::*;

use super::dof::star;
use crate::{Case, changed, valid};
use testkit::fixture::Fixture;
use testkit::robot::limit;

const CHAIN: &str = "chain_module";

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
    vec![
        valid(CHN001, "names-that-differ-in-case", || {
            star(&[("a", JointType::Fixed), ("A", JointType::Fixed)])
        }),
        valid(CHN002, "joint-named-as-a-link", || star(&[("base", JointType::Revolute)])),
        valid(CHN004, "joints-and-links-in-different-orders", || {
            let mut robot = star(&[("a", JointType::Revolute), ("b", JointType::Revolute)]);
            robot.urdf.links.reverse();
            robot
        }),
        valid(CHN006, "root-is-the-last-link", || {
            let mut robot = star(&[("a", JointType::Revolute)]);
            robot.urdf.links.reverse();
            robot
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
            "quaternion-of-any-length",
            false,
            "1.1",
            [-2.4, 0.0, 0.0, -1.8],
            [0.6, 0.8, 0.0, 0.0],
        ),
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
        valid(CHN009, "tiny-axis-and-axis-of-a-fixed-joint", || {
            let mut robot = star(&[("a", JointType::Revolute), ("b", JointType::Fixed)]);
            let axis = |xyz| Some(Axis { xyz: Some(xyz) });
            robot.joint_mut("a").axis = axis([0.0, 3e-100, 4e-100]);
            robot.joint_mut("b").axis = axis([0.0, 0.0, 0.0]);
            robot
        }),
    ]
}
