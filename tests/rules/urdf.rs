//! URD: other robots.

use urdd_format::urdf::{Axis, Mimic};
use urdd_validate::code::Code::*;

use crate::{Case, changed};
use testkit::fixture::{Fixture, toy_robot};
use testkit::robot::{Robot, link};

/// A valid URDD of a robot other than the toy.
fn sound(
    code: urdd_validate::code::Code,
    name: &'static str,
    change: impl Fn(&mut Robot) + 'static,
) -> Case {
    let base = move || {
        let mut robot = toy_robot();
        change(&mut robot);
        Fixture::core(&robot)
    };
    changed(code, name, false, base, |_| {})
}

pub fn cases() -> Vec<Case> {
    vec![
        changed(
            URD004,
            "one-link-and-no-joint",
            false,
            || {
                let mut robot = Robot::new("one");
                robot.urdf.links.push(link("only"));
                Fixture::core(&robot)
            },
            |_| {},
        ),
        sound(URD005, "two-joints-on-one-parent", |robot| {
            robot.joint_mut("bolt").parent.link = "puck".to_owned();
        }),
        sound(URD006, "deep-and-turned-round", |robot| {
            robot.joint_mut("bolt").parent.link = "eye".to_owned();
            robot.urdf.joints.reverse();
        }),
        sound(URD010, "axes-that-are-not-used", |robot| {
            for joint in ["flange", "air", "socket/ü"] {
                robot.joint_mut(joint).axis = axis([0.0; 3]);
            }
            robot.joint_mut("turn").axis = axis([0.0, 1e-9, 0.0]);
        }),
        sound(URD012, "mimic-of-a-continuous-joint", |robot| {
            robot.joint_mut("frozen").mimic = mimic("spin");
        }),
        // A version is two decimal numbers.
        changed(
            URD011,
            "two-rotations-in-a-version-with-a-sign",
            false,
            || {
                let mut robot = toy_robot();
                robot.urdf.version = Some("+1.1".to_owned());
                let origin = &mut robot.joint_mut("bolt").origin;
                origin.as_mut().expect("it has").rpy = Some([0.1, 0.2, 0.3]);
                Fixture::core(&robot)
            },
            |_| {},
        ),
        changed(
            URD011,
            "two-rotations-before-1.1",
            false,
            || {
                let mut robot = toy_robot();
                robot.urdf.version = None;
                let origin = &mut robot.joint_mut("bolt").origin;
                origin.as_mut().expect("it has").rpy = Some([0.1, 0.2, 0.3]);
                Fixture::core(&robot)
            },
            |_| {},
        ),
    ]
}

fn mimic(joint: &str) -> Option<Mimic> {
    Some(Mimic { joint: joint.to_owned(), multiplier: None, offset: None })
}

fn axis(xyz: [f64; 3]) -> Option<Axis> {
    Some(Axis { xyz: Some(xyz) })
}
