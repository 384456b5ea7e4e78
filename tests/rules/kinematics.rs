//! KIN: a long line of links.

use urdd_format::urdf::{Axis, JointType};
use urdd_validate::code::Code::*;

use crate::{Case, changed};
use testkit::fixture::{Fixture, URDF};
use testkit::robot::{Robot, joint, link, origin, solid_box};

/// Twelve links in a line, each this far from the one before.
fn line(step: f64) -> Robot {
    let mut robot = Robot::new("line");
    for i in 0..12 {
        let mut link = link(&format!("l{i}"));
        link.inertial = Some(solid_box(1.0, [0.1; 3]));
        robot.urdf.links.push(link);
    }
    for i in 1..12 {
        let (parent, child) = (format!("l{}", i - 1), format!("l{i}"));
        let mut joint = joint(&format!("j{i}"), JointType::Continuous, &parent, &child);
        joint.origin = origin([step, 0.0, 0.0], [0.0; 3]);
        robot.urdf.joints.push(joint);
    }
    robot
}

/// The URDD of a line in which all modules except `urdf_module` have steps that are longer by `by`.
fn off(by: f64) -> Fixture {
    let mut fixture = Fixture::core(&line(0.1 + by));
    let right = Fixture::core(&line(0.1));
    *fixture.doc_mut("urdf_module") = right.doc("urdf_module").clone();
    fixture.put_file(URDF, right.file(URDF));
    fixture
}

/// The same where all links but the first are at one place, and are turned about x by so much, each from the one before.
fn turned(by: f64) -> Fixture {
    let of = |turn: f64| {
        let mut robot = line(0.0);
        for joint in &mut robot.urdf.joints {
            joint.origin = origin([0.0; 3], [turn, 0.0, 0.0]);
        }
        robot.joint_mut("j1").origin = origin([1.0, 0.0, 0.0], [turn, 0.0, 0.0]);
        Fixture::core(&robot)
    };
    let (mut fixture, right) = (of(by), of(0.0));
    *fixture.doc_mut("urdf_module") = right.doc("urdf_module").clone();
    fixture.put_file(URDF, right.file(URDF));
    fixture
}

pub fn cases() -> Vec<Case> {
    vec![
        changed(KIN001, "many-small-turns", true, || turned(5e-10), |_| {}),
        changed(KIN001, "many-smaller-turns", false, || turned(0.9e-10), |_| {}),
        // The reach is 1.1 m: each origin is within tolerance, but the last link is not.
        changed(KIN001, "many-small-differences", true, || off(1e-9), |_| {}),
        changed(KIN001, "many-smaller-differences", false, || off(0.9e-10), |_| {}),
        // SPEC 6.1.8: absent, as a whole.
        changed(
            KIN001,
            "numbers-that-are-not-finite",
            false,
            || {
                let mut robot = line(0.1);
                let origin = robot.joint_mut("j3").origin.as_mut().expect("it has");
                (origin.xyz, origin.rpy) = (None, Some([0.11, 0.22, 0.33]));
                robot.joint_mut("j4").axis = Some(Axis { xyz: None });
                Fixture::core(&robot)
            },
            |f| {
                let finite = "<origin rpy=\"0.11 0.22 0.33\"";
                f.urdf_replace(finite, &finite.replace(" rpy", " xyz=\"0 -Infinity 1e999\" rpy"));
                f.urdf_replace("<axis/>", "<axis xyz=\"0 NaN 1\"/>");
            },
        ),
    ]
}
