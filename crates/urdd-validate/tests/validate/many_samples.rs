//! LOP008 looks at so many closed samples, and says where it did not look at all.

use serde_json::{Value, json};
use testkit::fixture::Fixture;
use testkit::robot::{Robot, joint, link};
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::{Axis, JointType};
use urdd_validate::settings::Settings;
use urdd_validate::validate_source;

/// Couplings that hold a hinge at 0.
const COUPLINGS: usize = 2_000;

fn held(samples: usize, last: f64) -> Fixture {
    let mut robot = Robot::new("hinge");
    robot.urdf.links.extend([link("base"), link("arm")]);
    let mut hinge = joint("hinge", JointType::Continuous, "base", "arm");
    hinge.axis = Some(Axis { xyz: Some([0.0, 0.0, 1.0]) });
    robot.urdf.joints.push(hinge);
    let coupling = |k: usize| {
        let terms = json!([{ "dof_idx": 0, "coefficients": [1.0, 0.0, 0.0, 0.0] }]);
        json!({ "name": format!("hold_{k}"), "constant": 0.0, "terms": terms })
    };
    let sample = |k: usize| json!({ "sample_idx": k, "configuration": [0.0] });
    let mut document = json!({
        "loops": [], "couplings": (0..COUPLINGS).map(coupling).collect::<Vec<_>>(),
        "independent_dof_idxs": [], "reference_configuration": [0.0],
        "closed_samples": (0..samples).map(sample).collect::<Vec<_>>(),
    });
    document["couplings"][COUPLINGS - 1]["constant"] = json!(last);
    Fixture::core_with(&robot, ModuleKind::Loops, document)
}

/// What became of LOP008: its status, and the reason why it was skipped.
fn status(fixture: &Fixture) -> (String, String) {
    let run = validate_source(fixture.in_memory(), "hinge", &Settings::default());
    let report = serde_json::to_value(run.expect("a report").report).expect("JSON");
    let mut checks = report["urdds"][0]["checks"].as_array().expect("checks").iter();
    let check = checks.find(|check: &&Value| check["code"] == "LOP008").expect("the rule");
    let text = |key: &str| check[key].as_str().unwrap_or_default().to_owned();
    (text("status"), text("reason"))
}

#[test]
fn what_was_not_looked_at_is_said() {
    // 20 million couplings, terms and links in all: 4,997 configurations, of which one is the reference.
    assert_eq!(status(&held(4_996, 0.0)).0, "passed");
    let (status_of, reason) = status(&held(4_997, 0.0));
    assert_eq!(status_of, "skipped", "{reason}");
    assert!(reason.contains("more closed samples than"), "{reason}");
    // A fault among those that were looked at is a finding all the same.
    assert_eq!(status(&held(4_997, 1e-3)).0, "failed");
}
