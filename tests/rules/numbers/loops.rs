//! Numbers of clause 6.8: kinematic loops.

use std::f64::consts::PI;

use serde_json::json;
use urdd_validate::code::Code::*;

use super::agreement::add;
use super::{Number, Sides, least, most, number};
use crate::loops::{free, linkage};
use testkit::fixture::Fixture;

const LOOPS: &str = "loops_module";
const REFERENCE: &str = "/reference_configuration";
/// The reach of the base `loops_free`, m.
const REACH: f64 = 1.5;

fn add_to_reference(f: &mut Fixture, dof: usize, by: f64) {
    add(f, LOOPS, &format!("{REFERENCE}/{dof}"), by);
}

/// A gear whose summands at the reference configuration are 0.25, 0.5 and 0.25.
fn gear() -> Fixture {
    let mut gear = linkage();
    gear.set(LOOPS, "/closed_samples", json!([]));
    gear
}

/// A joint that is held at 0.
fn held_at_zero(f: &mut Fixture, constant: f64) {
    let term = json!({ "dof_idx": 4, "coefficients": [1.0, 0.0, 0.0, 0.0] });
    f.set(LOOPS, "/couplings/0", json!({ "name": "held", "constant": constant, "terms": [term] }));
    f.set(LOOPS, "/reference_configuration/4", json!(0.0));
}

/// Half a turn about z that is longer by this part.
fn half_a_turn(f: &mut Fixture, longer: f64) {
    f.set(LOOPS, "/loops/0/frame_a/quaternion_wxyz", json!([0.0, 0.0, 0.0, 1.0]));
    f.set(LOOPS, "/loops/0/rotation_tolerance", json!(1e-8));
    f.set(LOOPS, "/reference_configuration/5", json!(PI * (1.0 + longer)));
}

/// Two gears between the same wheels: of the two singular values, one is this part of the other.
fn nearly_the_same(f: &mut Fixture, part: f64, independent: &[usize]) {
    let gear = |name: &str, ratio: f64| {
        let term =
            |dof: usize, c: f64| json!({ "dof_idx": dof, "coefficients": [c, 0.0, 0.0, 0.0] });
        json!({ "name": name, "constant": 0.0, "terms": [term(3, 1.0), term(4, ratio)] })
    };
    f.set(LOOPS, "/loops", json!([]));
    f.set(LOOPS, "/couplings", json!([gear("one", 1.0), gear("other", 1.0 + 4.0 * part)]));
    f.set(LOOPS, "/independent_dof_idxs", json!(independent));
    f.set(LOOPS, REFERENCE, json!(vec![0.0; 6]));
}

/// Clause 6.8.
pub fn numbers() -> Vec<Number> {
    let longer = |f: &mut Fixture, by: f64| {
        f.set(LOOPS, "/loops/0/frame_a/quaternion_wxyz", json!([1.0 + by, 0.0, 0.0, 0.0]));
    };
    let position = |f: &mut Fixture, by: f64| {
        f.set(LOOPS, "/loops/0/position_tolerance", json!(by));
    };
    let rotation = |f: &mut Fixture, by: f64| {
        f.set(LOOPS, "/loops/0/rotation_tolerance", json!(by));
    };
    vec![
        number(
            "loop-quaternion",
            "6.8.2",
            "a norm within 1e-9 of 1",
            ("1e-9", 1e-9),
            vec![most(LOP003, free, longer, 1e-9)],
        ),
        number(
            "loop-position-gap",
            "6.8.4",
            "plus 1e-9 of the robot's reach",
            ("1e-9", 1e-9),
            vec![most(LOP008, free, |f, by| add_to_reference(f, 2, by), 1e-9 * REACH)],
        ),
        number(
            "loop-rotation-gap",
            "6.8.4",
            "`rotation_tolerance` plus 1e-9",
            ("1e-9", 1e-9),
            vec![most(LOP008, free, |f, by| add_to_reference(f, 4, by), 1e-9)],
        ),
        number(
            "loop-loose-position",
            "6.8.4",
            "at most 1e-6 of the reach",
            ("1e-6", 1e-6),
            vec![most(LOP012, free, position, 1e-6 * REACH)],
        ),
        number(
            "loop-loose-rotation",
            "6.8.4",
            "and 1e-6. [LOP012]",
            ("1e-6", 1e-6),
            vec![most(LOP012, free, rotation, 1e-6)],
        ),
        number(
            "coupling-sum",
            "6.8.5",
            "at most 1e-9 of the sum of the absolute values",
            ("1e-9", 1e-9),
            vec![most(LOP008, gear, |f, by| add(f, LOOPS, "/couplings/0/constant", by), 1e-9)],
        ),
        number(
            "coupling-least-sum",
            "6.8.5",
            "or at most 1e-12",
            ("1e-12", 1e-12),
            vec![most(LOP008, gear, held_at_zero, 1e-12)],
        ),
        number(
            "loop-rotation-vector",
            "6.8.6",
            "longer than pi times 1 + 1e-9",
            ("1e-9", 1e-9),
            vec![most(LOP007, free, half_a_turn, 1e-9)],
        ),
        number(
            "loop-least-singular-value",
            "6.8.7",
            "that are more than 1e-9,",
            ("1e-9", 1e-9),
            vec![Sides::Elsewhere(
                "a loop whose rows are as small ends at positions that agree (5.6); rows of couplings are 1 at least",
            )],
        ),
        number(
            "loop-rank",
            "6.8.7",
            "more than 1e-5 of the largest one;",
            ("1e-5", 1e-5),
            vec![Sides::Elsewhere("it may be counted either way: the next two have the sides")],
        ),
        number(
            "loop-rank-that-may-count",
            "6.8.7",
            "A singular value from 1e-6",
            ("1e-6", 1e-6),
            vec![least(LOP009, gear, |f, part| nearly_the_same(f, part, &[0, 1, 2, 5]), 1e-6)],
        ),
        number(
            "loop-rank-that-counts",
            "6.8.7",
            "to 1e-4 of the largest one",
            ("1e-4", 1e-4),
            vec![most(LOP009, gear, |f, part| nearly_the_same(f, part, &[0, 1, 2, 3, 5]), 1e-4)],
        ),
    ]
}
