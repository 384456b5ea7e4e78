//! BND. DOFs of the toy: 0 turn [-2.5, 2.5], 1 shoulder, 2 slide, 3 to 5 plane, 6 to 11 air, 12 to 14
//! socket/ü, 15 spin (continuous), 16 left, 17 locked at 0.25.

use serde_json::{Value, json};
use urdd_format::urdf::{JointType, Limit};
use urdd_validate::code::Code::*;

use super::dof::star;
use crate::{Case, changed, invalid, near_miss};
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
    let valid = |code, name, robot: fn() -> Robot| {
        changed(code, name, false, move || Fixture::core(&robot()), |_| {})
    };
    vec![
        invalid(BND001, "flag-missing", |f| {
            f.remove(BOUNDS, "/dof_limited/3");
        }),
        invalid(BND001, "bounds-of-mimics-too", |f| {
            for list in [
                "bounds",
                "dof_lower_bounds",
                "dof_upper_bounds",
                "dof_limited",
                "dof_velocity_limits",
                "dof_effort_limits",
            ] {
                let last = f.get(BOUNDS, &format!("/{list}/17")).clone();
                f.set(BOUNDS, &format!("/{list}/-"), last);
            }
        }),
        valid(BND001, "no-dofs", || star(&[("j", JointType::Fixed)])),
        invalid(BND002, "column-off", |f| {
            f.set(BOUNDS, "/dof_upper_bounds/1", json!(1.4));
        }),
        invalid(BND002, "pair-off", |f| {
            f.set(BOUNDS, "/bounds/1/0", json!(-1.1));
        }),
        near_miss(BND002, "column-rounded", |f| {
            f.set(BOUNDS, "/dof_upper_bounds/0", json!(2.500_000_000_1));
        }),
        invalid(BND003, "degrees", |f| bound(f, 0, -143.0, 143.0)),
        invalid(BND003, "ends-swapped", |f| bound(f, 0, 2.5, -2.5)),
        invalid(BND003, "locked-joint-widened", |f| bound(f, 17, 0.25, 0.25 + 1e-7)),
        near_miss(BND003, "rounded", |f| {
            bound(f, 0, -2.500_000_000_001, 2.500_000_000_001);
        }),
        valid(BND003, "one-limit-alone", || limited(JointType::Revolute, Some(-1.0), None)),
        valid(BND003, "locked", || limited(JointType::Prismatic, Some(0.3), Some(0.3))),
        invalid(BND004, "continuous-said-to-be-limited", |f| {
            f.set(BOUNDS, "/dof_limited/15", json!(true));
        }),
        invalid(BND004, "locked-said-to-be-free", |f| {
            f.set(BOUNDS, "/dof_limited/17", json!(false));
        }),
        valid(BND004, "continuous-with-limits", || {
            limited(JointType::Continuous, Some(-1.0), Some(1.0))
        }),
        invalid(BND005, "no-limit-for-a-limit", |f| {
            f.set(BOUNDS, "/dof_velocity_limits/0", Value::Null);
        }),
        invalid(BND005, "limit-for-no-limit", |f| {
            f.set(BOUNDS, "/dof_effort_limits/15", json!(0.0));
        }),
        invalid(BND005, "another-number", |f| {
            let old = f.get(BOUNDS, "/dof_effort_limits/1").as_f64().expect("a number");
            f.set(BOUNDS, "/dof_effort_limits/1", json!(old * 1.001));
        }),
        valid(BND005, "velocity-of-a-floating-joint-and-a-limit-of-0", || {
            let mut robot = limited(JointType::Floating, None, None);
            let mut other = star(&[("k", JointType::Revolute)]);
            other.joint_mut("k").limit =
                Some(Limit { velocity: Some(0.0), ..limit(-1.0, 1.0).expect("a limit") });
            robot.urdf.links.extend(other.urdf.links.drain(1..));
            robot.urdf.joints.append(&mut other.urdf.joints);
            robot
        }),
        invalid(BND006, "frozen", |f| bound(f, 15, 0.0, 1e-7)),
        invalid(BND006, "whole-turns", |f| {
            bound(f, 15, -std::f64::consts::TAU, std::f64::consts::TAU);
        }),
        invalid(BND006, "length-taken-for-an-angle", |f| {
            bound(f, 3, -std::f64::consts::PI, std::f64::consts::PI);
        }),
        #[expect(clippy::approx_constant, reason = "pi as others round it")]
        near_miss(BND006, "pi-rounded", |f| bound(f, 15, -3.141_592_653_6, 3.141_592_653_6)),
    ]
}
