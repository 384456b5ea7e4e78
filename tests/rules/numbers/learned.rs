//! Numbers about the model of self-collision.

use serde_json::json;
use urdd_validate::code::Code::*;

use super::{Number, Sides, most, number, there};
use crate::shapes::number as value;
use testkit::fixture::Fixture;
use testkit::model::{MODEL, fixture as model};

fn clearance(f: &mut Fixture, by: f64) {
    let clip = value(f, MODEL, "/clip_distance");
    let old = value(f, MODEL, "/test_vectors/1/clearances/0");
    let scale = clip.abs().max(old.abs());
    f.set(MODEL, "/test_vectors/1/clearances/0", json!(old + by * scale));
}

pub fn numbers() -> Vec<Number> {
    vec![
        number(
            "weights",
            "8.8.4",
            "at most 65,536 weights and biases",
            ("65,536", 65_536.0),
            vec![Sides::Elsewhere(
                "cases of 2 MB: tests/rules/learned.rs judges models of 65,525 and 65,549",
            )],
        ),
        number(
            "test-vectors",
            "8.8.4",
            "at most 100 test vectors",
            ("100", 100.0),
            vec![there("LRN005/a-hundred-and-one-test-vectors", "LRN005/a-hundred-test-vectors")],
        ),
        number(
            "clearance",
            "8.8.6",
            "within 1e-9 of the larger absolute value, or of `clip_distance`",
            ("1e-9", 1e-9),
            vec![most(LRN008, model, clearance, 1e-9)],
        ),
        number(
            "reserved-configurations",
            "8.8.8",
            "below 2^31",
            ("2^31", 2_147_483_648.0),
            vec![there("LRN009/trained-on-the-evaluation", "LRN009/trained-up-to-the-evaluation")],
        ),
        number(
            "all-configurations",
            "8.8.8",
            "add up to 50,000",
            ("50,000", 50_000.0),
            vec![there("LRN009/one-configuration-short", "LRN011/as-it-is")],
        ),
        number(
            "evaluation",
            "8.8.9",
            "2^31 to 2^31 + 49,999: 50,000 that are the same",
            ("50,000", 50_000.0),
            vec![there("LRN010/misses-off-by-three", "LRN010/misses-off-by-two")],
        ),
        number(
            "counted-among",
            "8.8.9",
            "all 50,000 |",
            ("50,000", 50_000.0),
            vec![there("LRN009/one-configuration-short", "LRN011/as-it-is")],
        ),
        number(
            "counted-by-a-validator",
            "8.8.9",
            "A validator counts all 50,000",
            ("50,000", 50_000.0),
            vec![there("LRN010/misses-off-by-three", "LRN010/misses-off-by-two")],
        ),
        number(
            "fewest-collisions",
            "8.8.9",
            "each be at least 200",
            ("200", 200.0),
            vec![there("LRN012/199-collisions", "LRN012/200-collisions")],
        ),
        number(
            "tolerance-of-a-count",
            "8.8.9",
            "by n / 10,000, rounded up",
            ("10,000", 10_000.0),
            vec![there("LRN010/five-more-cleared", "LRN010/four-more-cleared")],
        ),
        number(
            "near-contact",
            "8.8.10",
            "the smaller of 1 and 0.05 / max",
            ("0.05", 0.05),
            vec![there("LRN010/near-contact-off-by-three", "LRN011/as-it-is")],
        ),
        number(
            "near-contact-step",
            "8.8.10",
            "more than 0.05 rad or 0.05 m",
            ("0.05", 0.05),
            vec![Sides::Elsewhere("it follows from the sentence before")],
        ),
        number(
            "other-configurations",
            "8.8.12",
            "two more ranges of 25,000 sampled configurations each: those from 2^31 + 2^20 on, and those from 2^31 + 2^30 + h on",
            ("25,000", 25_000.0),
            vec![Sides::Elsewhere(
                "a statistic: LRN011/learned-by-heart and LRN011/as-it-is are far from its edge",
            )],
        ),
        number(
            "bits-of-the-digest",
            "8.8.12",
            "the first 29 bits",
            ("29", 29.0),
            vec![Sides::Elsewhere("a statistic: other configurations give about the same rates")],
        ),
    ]
}
