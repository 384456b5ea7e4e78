//! BND: robots of other joints.

use serde_json::json;
use urdd_format::urdf::{JointType, Limit};
use urdd_validate::code::Code::*;

use super::dof::star;
use crate::{Case, valid};
use testkit::fixture::Fixture;
use testkit::robot::{Robot, limit};

const BOUNDS: &str = "bounds_module";

/// Bounds of a DOF, in all three places.
pub fn bound(fixture: &mut Fixture, dof: usize, lower: f64, upper: f64) {
    fixture.set(BOUNDS, &format!("/bounds/{dof}"), json!([lower, upper]));
    fixture.set(BOUNDS, &format!("/dof_lower_bounds/{dof}"), json!(lower));
    fixture.set(BOUNDS, &format!("/dof_upper_bounds/{dof}"), json!(upper));
}

fn limited(joint_type: JointType, lower: Option<f64>, upper: Option<f64>) -> Robot {
    let mut robot = star(&[("j", joint_type)]);
    robot.joint_mut("j").limit = Some(Limit {
        lower,
        upper,
        effort: None,
        velocity: Some(0.0),
        acceleration: None,
        deceleration: None,
        jerk: None,
    });
    robot
}

pub fn cases() -> Vec<Case> {
    vec![
        valid(BND001, "no-dofs", || star(&[("j", JointType::Fixed)])),
        valid(BND003, "one-limit-alone", || limited(JointType::Revolute, Some(-1.0), None)),
        valid(BND003, "upper-limit-alone", || limited(JointType::Revolute, None, Some(1.0))),
        valid(BND003, "locked", || limited(JointType::Prismatic, Some(0.3), Some(0.3))),
        valid(BND005, "velocity-of-a-floating-joint-and-a-limit-of-0", || {
            let mut robot = limited(JointType::Floating, None, None);
            let mut other = star(&[("k", JointType::Revolute)]);
            other.joint_mut("k").limit =
                Some(Limit { velocity: Some(0.0), ..limit(-1.0, 1.0).expect("a limit") });
            robot.urdf.links.extend(other.urdf.links.drain(1..));
            robot.urdf.joints.append(&mut other.urdf.joints);
            robot
        }),
    ]
}
