//! A robot of several loops, each with joints of another kind: a slide, a mimic joint in both of a loop's branches, a planar
//! joint, a ball.

use std::f64::consts::FRAC_PI_2;

use serde_json::json;
use testkit::fixture::Fixture;
use testkit::robot::limit;
use urdd_format::urdf::{JointType, Mimic};

use super::made::{X, Z, closing, core_with_loops, hinge, moved, robot};

const FLAT: [f64; 3] = [0.0; 3];
const CRANK: f64 = 0.1;
const ROD: f64 = 0.3;
const BAR: f64 = 0.25;
/// Where the planar joint's body is pinned, from the joint's origin along the two directions of its plane, and the pin's
/// place in the body.
const PIN: [f64; 2] = [0.2, -0.1];
const IN_BODY: f64 = 0.05;

/// A slider-crank; a parallelogram whose rocker mimics its crank; a body that a pin holds on a plane; a ball that may only
/// turn about z.
pub fn mixed() -> Fixture {
    let mut mixed = robot("mixed", "base");
    let at = |x: f64, y: f64| ([x, y, 0.0], FLAT);
    hinge(&mut mixed, "crank", "base", at(0.0, 0.0), Z, Some([-2.0, 2.0]));
    hinge(&mut mixed, "rod", "crank", at(CRANK, 0.0), Z, Some([-3.0, 3.0]));
    moved(&mut mixed, "block", JointType::Prismatic, "base", at(0.0, 0.0), Some(X));
    mixed.joint_mut("block_joint").limit = limit(0.0, 1.0);
    hinge(&mut mixed, "driver", "base", at(0.0, 0.5), Z, Some([-1.0, 1.0]));
    hinge(&mut mixed, "coupler", "driver", at(CRANK, 0.0), Z, Some([-2.0, 2.0]));
    hinge(&mut mixed, "rocker", "base", at(BAR, 0.5), Z, Some([-1.0, 1.0]));
    mixed.joint_mut("rocker_joint").mimic = Some(mimic("driver_joint", 1.0, 0.0));
    let tilted = ([0.0, 1.0, 0.0], [FRAC_PI_2, 0.0, 0.0]);
    moved(&mut mixed, "puck", JointType::Planar, "base", tilted, Some(Z));
    moved(&mut mixed, "ball", JointType::Spherical, "base", at(0.0, 1.5), None);
    let loops = vec![
        closing(&mixed, "pin", "Revolute", [("rod", [ROD, 0.0, 0.0]), ("block", FLAT)]),
        closing(
            &mixed,
            "bar",
            "Revolute",
            [("coupler", [BAR, 0.0, 0.0]), ("rocker", [CRANK, 0.0, 0.0])],
        ),
        // The plane's y is z of the base, where it is turned about x.
        closing(
            &mixed,
            "held",
            "Spherical",
            [("base", [PIN[0], 1.0, PIN[1]]), ("puck", [IN_BODY, 0.0, 0.0])],
        ),
        closing(&mixed, "upright", "Revolute", [("base", [0.0, 1.5, 0.0]), ("ball", FLAT)]),
    ];
    let closed = |q: &[f64]| {
        let (crank, driver, turn) = (q[0], q[3], q[7]);
        let rod = -(CRANK * crank.sin() / ROD).asin();
        let block = CRANK * crank.cos() + ROD * rod.cos();
        let puck = [PIN[0] - IN_BODY * turn.cos(), PIN[1] - IN_BODY * turn.sin()];
        // The ball follows nothing: of its rotation vector, z is free.
        Some(vec![
            crank,
            rod - crank,
            block,
            driver,
            -driver,
            puck[0],
            puck[1],
            turn,
            0.0,
            0.0,
            q[10],
        ])
    };
    let mut start = vec![0.0; 11];
    (start[0], start[3], start[7], start[10]) = (0.5, 0.25, 0.75, 2.0);
    core_with_loops(&mixed, [loops, vec![]], &[0, 3, 7, 10], closed, &start, 0)
}

/// How far the mast is away, m.
const FAR: f64 = 1e6;

/// A mast far away, so that the reach is large, a slide and a hinge that are held: lengths count by the reach.
pub fn far() -> Fixture {
    let mut far = robot("far", "base");
    moved(&mut far, "mast", JointType::Fixed, "base", ([FAR, 0.0, 0.0], FLAT), None);
    moved(&mut far, "slide", JointType::Prismatic, "base", (FLAT, FLAT), Some(X));
    far.joint_mut("slide_joint").limit = limit(-1.0, 1.0);
    hinge(&mut far, "turn", "base", ([0.0, 1.0, 0.0], FLAT), Z, Some([-1.0, 1.0]));
    let loops = vec![
        closing(&far, "stop", "Fixed", [("base", [0.25, 0.0, 0.0]), ("slide", FLAT)]),
        closing(&far, "lock", "Fixed", [("base", [0.0, 1.0, 0.0]), ("turn", FLAT)]),
    ];
    let closed = |_: &[f64]| Some(vec![0.25, 0.0]);
    core_with_loops(&far, [loops, vec![]], &[], closed, &[0.25, 0.0], 0)
}

/// A ball that turns as it likes, and a pin that holds a hinge.
pub fn ball() -> Fixture {
    let mut ball = robot("ball_and_pin", "base");
    moved(&mut ball, "ball", JointType::Spherical, "base", (FLAT, FLAT), None);
    hinge(&mut ball, "turn", "base", ([0.0, 1.0, 0.0], FLAT), Z, Some([-1.0, 1.0]));
    let lock = closing(&ball, "lock", "Fixed", [("base", [0.0, 1.0, 0.0]), ("turn", FLAT)]);
    let closed = |q: &[f64]| Some(vec![q[0], q[1], q[2], 0.0]);
    core_with_loops(&ball, [vec![lock], vec![]], &[0, 1, 2], closed, &[0.1, 0.2, 0.3, 0.0], 3)
}

/// Where the hinge stands that mimics a fixed joint, rad.
const STILL: f64 = 0.25;

/// Three slides, of which two mimic the first, so that the last stays where it is; a hinge on them that mimics a fixed
/// joint; a wheel, and one that follows it.
pub fn mimics() -> Fixture {
    let mut mimics = robot("mimics", "base");
    let here = (FLAT, FLAT);
    let slides =
        [("a", "base", X, None), ("b", "a", [-1.0, 0.0, 0.0], Some(2.0)), ("c", "b", X, Some(1.0))];
    for (name, parent, axis, factor) in slides {
        moved(&mut mimics, name, JointType::Prismatic, parent, here, Some(axis));
        let far = 2.0 * factor.unwrap_or(1.0);
        let slide = mimics.joint_mut(&format!("{name}_joint"));
        slide.limit = limit(-far, far);
        slide.mimic = factor.map(|factor| mimic("a_joint", factor, 0.0));
    }
    moved(&mut mimics, "mount", JointType::Fixed, "base", here, None);
    hinge(&mut mimics, "still", "c", here, Z, Some([-1.0, 1.0]));
    mimics.joint_mut("still_joint").mimic = Some(mimic("mount_joint", 3.0, STILL));
    hinge(&mut mimics, "wheel", "base", here, Z, None);
    hinge(&mut mimics, "follower", "wheel", here, Z, None);
    mimics.joint_mut("follower_joint").mimic = Some(mimic("wheel_joint", 2.0, 0.0));
    let mut held = closing(&mimics, "held", "Fixed", [("base", FLAT), ("still", FLAT)]);
    let half = STILL / 2.0;
    held["frame_a"]["quaternion_wxyz"] = json!([half.cos(), 0.0, 0.0, half.sin()]);
    let centre = closing(&mimics, "centre", "Spherical", [("base", FLAT), ("follower", FLAT)]);
    let closed = |q: &[f64]| Some(vec![q[0], q[1]]);
    core_with_loops(&mimics, [vec![held, centre], vec![]], &[0, 1], closed, &[0.5, 0.75], 3)
}

fn mimic(joint: &str, multiplier: f64, offset: f64) -> Mimic {
    Mimic { joint: joint.to_owned(), multiplier: Some(multiplier), offset: Some(offset) }
}
