//! LRN.

use serde_json::{Value, json};
use urdd::validate::code::Code;
use urdd::validate::code::Code::*;

use crate::support::model::{MODEL, Said, fixture, fixture_with, trained_on};
use crate::{Case, changed};

/// A case with some values that are others.
fn case(code: Code, name: &'static str, caught: bool, changes: &[(&'static str, Value)]) -> Case {
    let changes = changes.to_vec();
    changed(code, name, caught, fixture, move |fixture| {
        for (pointer, value) in &changes {
            fixture.set(MODEL, pointer, value.clone());
        }
    })
}

/// A case in which another module changes, and the model says that it was trained on it.
fn trained_again(
    code: Code,
    name: &'static str,
    caught: bool,
    changes: &[(&'static str, &'static str, Value)],
) -> Case {
    let changes = changes.to_vec();
    changed(code, name, caught, fixture, move |fixture| {
        for (module, pointer, value) in &changes {
            fixture.set(module, pointer, value.clone());
        }
        fixture.seal();
        let digest = trained_on(fixture);
        fixture.set(MODEL, "/trained_on", json!(digest));
    })
}

/// By one more or fewer, a count of 400 is right.
fn count(key: &str, by: i64) -> Value {
    let count = fixture().get(MODEL, key).as_i64().expect("a count");
    json!(count + by)
}

/// Nine collisions, none of which a model misses that misses four of five: they are far to seek.
const LUCKY: Said = Said {
    margin: -0.2,
    held_out: [35_257_842, 24],
};

pub fn cases() -> Vec<Case> {
    let missed = fixture()
        .get(MODEL, "/held_out/num_missed")
        .as_u64()
        .expect("a count");
    let long = vec![json!(1.0); 19];
    vec![
        case(
            LRN001,
            "link-beyond-the-last",
            true,
            &[("/pairs/4/link_b_idx", json!(5))],
        ),
        case(
            LRN001,
            "dof-beyond-the-last",
            true,
            &[("/inputs/1/Angle/dof_idx", json!(6))],
        ),
        case(
            LRN001,
            "pair-in-both-lists",
            true,
            &[(
                "/other_pairs",
                json!([{ "link_a_idx": 0, "link_b_idx": 2 }, { "link_a_idx": 0, "link_b_idx": 4 }]),
            )],
        ),
        case(
            LRN001,
            "higher-link-first",
            true,
            &[(
                "/other_pairs",
                json!([{ "link_a_idx": 4, "link_b_idx": 0 }]),
            )],
        ),
        case(
            LRN001,
            "extension-key-beside",
            false,
            &[("/pairs/0/x_note", json!("post and tip"))],
        ),
        case(
            LRN002,
            "angle-of-a-length",
            true,
            &[("/inputs/2", json!({ "Angle": { "dof_idx": 2 } }))],
        ),
        case(
            LRN002,
            "dof-twice",
            true,
            &[("/inputs/1/Angle/dof_idx", json!(0))],
        ),
        case(
            LRN002,
            "rotation-vector-in-another-order",
            true,
            &[("/inputs/3/RotationVector/dof_idxs", json!([4, 3, 5]))],
        ),
        case(
            LRN002,
            "range-of-nothing",
            true,
            &[("/inputs/2/Length/half_range", json!(0.0))],
        ),
        case(
            LRN002,
            "extension-key-beside",
            false,
            &[("/inputs/2/Length/x_unit", json!("m"))],
        ),
        case(
            LRN003,
            "row-too-long",
            true,
            &[("/layers/0/weights/1", json!(long))],
        ),
        case(
            LRN003,
            "bias-missing",
            true,
            &[("/layers/1/biases", json!([0.2, 0.15, 0.15, 0.1]))],
        ),
        case(
            LRN003,
            "no-test-vector",
            true,
            &[("/test_vectors", json!([]))],
        ),
        case(
            LRN003,
            "one-test-vector",
            false,
            &[(
                "/test_vectors",
                json!([fixture().get(MODEL, "/test_vectors/1")]),
            )],
        ),
        case(
            LRN004,
            "sum-beyond-binary64",
            true,
            &[("/layers/0/weights/0", {
                let mut row = vec![0.0; 18];
                row[0] = 1.7e308;
                row[1] = 1.7e308;
                json!(row)
            })],
        ),
        // Nothing depends on the fourth value.
        case(
            LRN004,
            "large-and-within-binary64",
            false,
            &[("/layers/0/weights/3/0", json!(1.7e308))],
        ),
        case(
            LRN005,
            "a-million-and-one-configurations",
            true,
            &[("/held_out/num_configurations", json!(1_000_001))],
        ),
        case(
            LRN005,
            "calibrated-on-two-million",
            false,
            &[
                ("/calibration/first_sample_idx", json!(1000)),
                ("/calibration/num_configurations", json!(2_000_000)),
            ],
        ),
        case(
            LRN006,
            "digest-of-something-else",
            true,
            &[("/trained_on", json!("0".repeat(64)))],
        ),
        changed(LRN006, "skips-edited", true, fixture, |fixture| {
            fixture.set(
                "link_shapes_skips_module",
                "/x_note",
                json!("looked at by hand"),
            );
        }),
        changed(LRN006, "connections-changed", false, fixture, |fixture| {
            fixture.set("connections_module", "/x_note", json!("looked at by hand"));
        }),
        case(
            LRN007,
            "pair-left-out",
            true,
            &[("/other_pairs", json!([]))],
        ),
        trained_again(
            LRN007,
            "trained-on-a-note",
            false,
            &[(
                "link_shapes_skips_module",
                "/x_note",
                json!("looked at by hand"),
            )],
        ),
        case(
            LRN008,
            "clearance-off-by-a-nanometre",
            true,
            &[("/test_vectors/1/clearances/0", {
                let fixture = fixture();
                let clearance = fixture.get(MODEL, "/test_vectors/1/clearances/0");
                json!(clearance.as_f64().expect("a number") + 1e-9)
            })],
        ),
        case(
            LRN008,
            "clearance-off-by-rounding",
            false,
            &[("/test_vectors/1/clearances/0", {
                let fixture = fixture();
                let clearance = fixture.get(MODEL, "/test_vectors/1/clearances/0");
                json!(clearance.as_f64().expect("a number") + 5e-11)
            })],
        ),
        case(
            LRN009,
            "held-out-was-trained-on",
            true,
            &[
                ("/training/num_configurations", json!(501)),
                ("/calibration/first_sample_idx", json!(10_000)),
            ],
        ),
        case(
            LRN009,
            "more-missed-than-colliding",
            true,
            &[("/held_out/num_missed", json!(401))],
        ),
        case(
            LRN009,
            "trained-up-to-the-held-out",
            false,
            &[
                ("/training/num_configurations", json!(500)),
                ("/calibration/first_sample_idx", json!(900)),
            ],
        ),
        case(
            LRN010,
            "misses-halved",
            true,
            &[("/held_out/num_missed", json!(missed / 2))],
        ),
        case(
            LRN010,
            "two-more-cleared",
            true,
            &[("/held_out/num_cleared", count("/held_out/num_cleared", 2))],
        ),
        case(
            LRN010,
            "one-more-cleared",
            false,
            &[("/held_out/num_cleared", count("/held_out/num_cleared", 1))],
        ),
        changed(
            LRN011,
            "lucky-configurations",
            true,
            || fixture_with(LUCKY),
            |_| {},
        ),
        changed(LRN011, "as-it-is", false, fixture, |_| {}),
    ]
}
