//! KIN.

use serde_json::json;
use urdd::validate::code::Code::*;

use crate::support::fixture::Fixture;
use crate::{Case, invalid, near_miss};

const SAMPLES: &str = "kinematics_samples_module";

fn nudge(fixture: &mut Fixture, pointer: &str, by: f64) {
    let old = fixture.get(SAMPLES, pointer).as_f64().expect("a number");
    fixture.set(SAMPLES, pointer, json!(old + by));
}

pub fn cases() -> Vec<Case> {
    vec![
        invalid(KIN002, "sampled-value-off", |f| {
            nudge(f, "/samples/4/configuration/0", 1e-6)
        }),
        near_miss(KIN002, "sampled-value-rounded", |f| {
            nudge(f, "/samples/4/configuration/0", 1e-12)
        }),
        invalid(KIN003, "link-moved", |f| {
            nudge(f, "/samples/0/link_poses/1/position/0", 1e-5)
        }),
        invalid(KIN003, "quaternion-not-unit", |f| {
            f.set(
                SAMPLES,
                "/samples/2/link_poses/1/quaternion_wxyz",
                json!([2.0, 0.0, 0.0, 0.0]),
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
