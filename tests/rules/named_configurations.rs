//! CNF: `named_configurations_module`.

use serde_json::{Value, json};
use urdd_format::registry::ModuleKind;
use urdd_validate::code::Code;
use urdd_validate::code::Code::*;

use crate::{Case, changed};
use testkit::fixture::{Fixture, toy_robot};

const MODULE: &str = "named_configurations_module";

/// Places of DOFs of the robot of [`base`].
const TURN: usize = 0;
const SLIDE: usize = 2;
const LOCKED: usize = 17;

/// The default configuration, but for these DOFs. 0 is not within the bounds of the last DOF, which is locked at 0.25.
fn configuration(set: &[(usize, f64)]) -> Value {
    let mut values = [0.0; 18];
    values[LOCKED] = 0.25;
    for (dof, position) in set {
        values[*dof] = *position;
    }
    json!(values)
}

fn positions(set: &[(&str, f64)]) -> Value {
    let set = set.iter();
    set.map(|(name, position)| json!({ "dof_name": name, "position": position })).collect()
}

/// A small robot with two configurations.
fn base() -> Fixture {
    let home = [("turn", 0.5), ("shoulder", -0.25), ("slide", 0.1)];
    let document = json!({ "configurations": [
        {
            "name": "home",
            "positions": positions(&home),
            "configuration": configuration(&[(TURN, 0.5), (1, -0.25), (SLIDE, 0.1)]),
        },
        { "name": "rest", "positions": [], "configuration": configuration(&[]) },
    ]});
    Fixture::core_with(&toy_robot(), ModuleKind::NamedConfigurations, document)
}

/// A case in which values of the second configuration are changed.
fn rest(code: Code, name: &'static str, caught: bool, changes: &[(&'static str, Value)]) -> Case {
    let changes = changes.to_vec();
    changed(code, name, caught, base, move |fixture| {
        for (key, value) in &changes {
            fixture.set(MODULE, &format!("/configurations/1/{key}"), value.clone());
        }
    })
}

/// A case in which the second configuration sets DOFs, and is what follows.
fn set(code: Code, name: &'static str, caught: bool, set: &[(&'static str, usize, f64)]) -> Case {
    let names: Vec<(&str, f64)> = set.iter().map(|(name, _, q)| (*name, *q)).collect();
    let places: Vec<(usize, f64)> = set.iter().map(|(_, dof, q)| (*dof, *q)).collect();
    let changes = [("positions", positions(&names)), ("configuration", configuration(&places))];
    rest(code, name, caught, &changes)
}

pub fn cases() -> Vec<Case> {
    let short: Value = configuration(&[]).as_array().expect("a list")[..LOCKED].into();
    vec![
        rest(SCH001, "configuration-of-no-name", true, &[("name", json!(""))]),
        rest(CNF001, "two-of-one-name", true, &[("name", json!("home"))]),
        rest(CNF001, "names-that-differ-in-case", false, &[("name", json!("Home"))]),
        rest(CNF002, "joint-renamed", true, &[("positions", positions(&[("turn_joint", 0.0)]))]),
        rest(CNF002, "joint-of-several-dofs", true, &[("positions", positions(&[("plane", 0.0)]))]),
        set(CNF002, "set-twice", true, &[("turn", TURN, 0.5), ("turn", TURN, 0.5)]),
        set(
            CNF002,
            "not-in-the-order-of-dofs",
            true,
            &[("slide", SLIDE, 0.1), ("turn", TURN, 0.5)],
        ),
        // A joint of one DOF, one of several, and a default value that is stated.
        set(
            CNF002,
            "in-the-order-of-dofs",
            false,
            &[("slide", SLIDE, 0.1), ("plane/rot", 5, 0.5), ("locked", LOCKED, 0.25)],
        ),
        set(CNF003, "above-the-upper-bound", true, &[("slide", SLIDE, 0.200_000_01)]),
        set(CNF003, "below-the-lower-bound", true, &[("turn", TURN, -30.0)]),
        set(CNF003, "off-where-it-is-locked", true, &[("locked", LOCKED, 0.0)]),
        // Within the tolerance of 5.6.
        set(CNF003, "at-the-upper-bound", false, &[("slide", SLIDE, 0.200_000_000_1)]),
        // A base that drives away, a wheel that turned, and a rotation vector of more than half a turn.
        set(
            CNF003,
            "beyond-the-bounds-of-dofs-without-limits",
            false,
            &[("plane/trans_x", 3, 30.0), ("air/rot_y", 10, 4.0), ("spin", 15, 7.0)],
        ),
        rest(CNF004, "set-and-not-followed", true, &[("positions", positions(&[("turn", 0.5)]))]),
        rest(
            CNF004,
            "followed-and-not-set",
            true,
            &[("configuration", configuration(&[(TURN, 0.5)]))],
        ),
        rest(
            CNF004,
            "zero-where-it-is-locked",
            true,
            &[("configuration", configuration(&[(LOCKED, 0.0)]))],
        ),
        rest(CNF004, "value-for-the-last-dof-missing", true, &[("configuration", short)]),
        rest(CNF004, "rounded", false, &[("configuration", configuration(&[(TURN, 1e-9)]))]),
    ]
}
