//! KIN.

use serde_json::json;
use urdd_format::urdf::{Axis, JointType};
use urdd_validate::code::Code::*;

use crate::{Case, changed, invalid, near_miss};
use testkit::fixture::{Fixture, URDF};
use testkit::robot::{Robot, joint, link, origin, solid_box};

const SAMPLES: &str = "kinematics_samples_module";

fn nudge(fixture: &mut Fixture, pointer: &str, by: f64) {
    let old = fixture.get(SAMPLES, pointer).as_f64().expect("a number");
    fixture.set(SAMPLES, pointer, json!(old + by));
}

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

pub fn cases() -> Vec<Case> {
    vec![
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
        invalid(KIN002, "sampled-value-off", |f| nudge(f, "/samples/4/configuration/0", 1e-6)),
        near_miss(KIN002, "sampled-value-rounded", |f| {
            nudge(f, "/samples/4/configuration/0", 1e-12)
        }),
        // The same rotation as (pi, 0, 0), but not the vector that SPEC 9.4 requires.
        invalid(KIN002, "upper-rotation-vector-is-lower", |f| {
            let dofs = f.get("dof_module", "/dofs").as_array().expect("a list");
            let first = dofs.iter().position(|dof| dof["name"] == "air/rot_x");
            let pointer = format!("/samples/3/configuration/{}", first.expect("a DOF"));
            nudge(f, &pointer, -2.0 * std::f64::consts::PI);
        }),
        invalid(KIN003, "quaternion-with-w-last", |f| {
            let pointer = "/samples/2/link_poses/1/quaternion_wxyz";
            f.set(SAMPLES, pointer, json!([0.0, 0.0, 0.0, 1.0]));
        }),
        invalid(KIN003, "link-moved", |f| nudge(f, "/samples/0/link_poses/1/position/0", 1e-5)),
        invalid(KIN003, "quaternion-not-unit", |f| {
            f.set(SAMPLES, "/samples/2/link_poses/1/quaternion_wxyz", json!([2.0, 0.0, 0.0, 0.0]));
        }),
        // Longer than SPEC 9.2 allows; it is read as the same rotation.
        invalid(KIN003, "quaternion-too-long", |f| {
            f.set(
                SAMPLES,
                "/samples/2/link_poses/1/quaternion_wxyz",
                json!([1.0 + 1e-8, 0.0, 0.0, 0.0]),
            );
        }),
        near_miss(KIN003, "quaternion-too-long-by-rounding", |f| {
            f.set(
                SAMPLES,
                "/samples/2/link_poses/1/quaternion_wxyz",
                json!([1.0 + 1e-12, 0.0, 0.0, 0.0]),
            );
        }),
        near_miss(KIN003, "link-moved-by-rounding", |f| {
            nudge(f, "/samples/0/link_poses/1/position/0", 1e-13)
        }),
        // The same rotation, but not as SPEC 5.4 writes it.
        invalid(KIN003, "opposite-quaternion", |f| {
            let pointer = "/samples/0/link_poses/1/quaternion_wxyz";
            let opposite: Vec<f64> = f
                .get(SAMPLES, pointer)
                .as_array()
                .expect("a list")
                .iter()
                .map(|x| -x.as_f64().expect("a number"))
                .collect();
            f.set(SAMPLES, pointer, json!(opposite));
        }),
        invalid(KIN004, "middle-missing", |f| {
            f.remove(SAMPLES, "/samples/1");
        }),
        invalid(KIN004, "pose-missing", |f| {
            f.remove(SAMPLES, "/samples/2/link_poses/0");
        }),
        invalid(KIN004, "sample-numbered-otherwise", |f| {
            f.set(SAMPLES, "/samples/4/sample_idx", json!(7))
        }),
        near_miss(KIN004, "fewer-sampled", |f| {
            let last = f.get(SAMPLES, "/samples").as_array().expect("a list").len() - 1;
            f.remove(SAMPLES, &format!("/samples/{last}"));
        }),
        invalid(KIN005, "module-missing", |f| f.remove_module(SAMPLES)),
        near_miss(KIN005, "only-the-named-four", |f| {
            while f.get(SAMPLES, "/samples").as_array().expect("a list").len() > 4 {
                f.remove(SAMPLES, "/samples/4");
            }
        }),
    ]
}
