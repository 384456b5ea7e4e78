//! The numbers of SPEC.md: every tolerance, limit, count and threshold that a clause states, with a case just on each
//! side of it. [`list`] is the one list; its cases are made from it. [`not_limits`] has the numbers of the clauses that
//! are none of these. Tests fail for a number that is in neither, and for an entry that a clause no longer states.

mod agreement;
mod documents;
pub mod geometry;
mod learned;
mod limits_of_files;
mod loops;
mod not_limits;
mod primitives;
mod shapes;
mod spec;
mod spheres;
mod tolerances;

use std::collections::BTreeMap;

use urdd_conformance::suite::CaseKind;
use urdd_validate::code::Code;

use crate::{Case, changed};
use testkit::fixture::Fixture;

/// A number that a clause states.
pub struct Number {
    /// Cases that are made for it have this in their names.
    id: &'static str,
    clause: &'static str,
    /// Words of the clause, which hold the number.
    words: &'static str,
    /// The number as it is written in `words`; its value follows.
    written: &'static str,
    value: f64,
    sides: Vec<Sides>,
}

/// Two cases, just on each side of a number.
pub enum Sides {
    /// Made from the list: the change with a size that is just beyond `at`, and with one that is just within.
    Made {
        code: Code,
        base: fn() -> Fixture,
        change: fn(&mut Fixture, f64),
        at: f64,
        beyond: f64,
        within: f64,
        /// Why the cases are farther away than [`JUST`]; empty where they are not.
        band: &'static str,
    },
    /// Written elsewhere, by `CODE/name`.
    Cases { beyond: &'static str, within: &'static str },
    /// No URDD can have it, or no small one. Says why, and what holds it instead.
    Elsewhere(&'static str),
}

/// How far from a number a case may be, as a part of it.
const JUST: f64 = 0.01;

/// Sizes 0.5 % more (rejected) and less than a limit.
pub fn most(code: Code, base: fn() -> Fixture, change: fn(&mut Fixture, f64), at: f64) -> Sides {
    sides(code, base, change, at, [1.005 * at, 0.995 * at])
}

/// Sizes 0.5 % less (rejected) and more than a limit.
pub fn least(code: Code, base: fn() -> Fixture, change: fn(&mut Fixture, f64), at: f64) -> Sides {
    sides(code, base, change, at, [0.995 * at, 1.005 * at])
}

/// Sizes one more (rejected) than a count, and the count.
pub fn count(code: Code, base: fn() -> Fixture, change: fn(&mut Fixture, f64), at: f64) -> Sides {
    sides(code, base, change, at, [at + 1.0, at])
}

/// These sizes, rejected and accepted.
pub fn sides(
    code: Code,
    base: fn() -> Fixture,
    change: fn(&mut Fixture, f64),
    at: f64,
    sizes: [f64; 2],
) -> Sides {
    wide(code, base, change, at, sizes, "")
}

/// The same, farther away for a reason: rounding, or a band in which implementations are free.
pub fn wide(
    code: Code,
    base: fn() -> Fixture,
    change: fn(&mut Fixture, f64),
    at: f64,
    [beyond, within]: [f64; 2],
    band: &'static str,
) -> Sides {
    Sides::Made { code, base, change, at, beyond, within, band }
}

/// Cases that are there.
pub fn there(beyond: &'static str, within: &'static str) -> Sides {
    Sides::Cases { beyond, within }
}

/// An entry.
pub fn number(
    id: &'static str,
    clause: &'static str,
    words: &'static str,
    (written, value): (&'static str, f64),
    sides: Vec<Sides>,
) -> Number {
    Number { id, clause, words, written, value, sides }
}

/// The list.
pub fn list() -> Vec<Number> {
    let mut list = agreement::numbers();
    list.extend(documents::numbers());
    list.extend(limits_of_files::numbers());
    list.extend(loops::numbers());
    list.extend(spheres::numbers());
    list.extend(geometry::numbers());
    list.extend(primitives::numbers());
    list.extend(shapes::numbers());
    list.extend(learned::numbers());
    list
}

/// The cases that are made from the list. `beyond` is caught, `within` is not.
pub fn cases() -> Vec<Case> {
    let mut cases = geometry::cases();
    cases.extend(primitives::cases());
    let mut times: BTreeMap<(&str, Code), usize> = BTreeMap::new();
    for number in list() {
        for sides in &number.sides {
            let Sides::Made { code, base, change, beyond, within, .. } = *sides else {
                continue;
            };
            let time = times.entry((number.id, code)).or_default();
            *time += 1;
            let again = if *time == 1 { String::new() } else { format!("-{time}") };
            for (side, size, caught) in [("beyond", beyond, true), ("within", within, false)] {
                // Some hundred, in a test.
                let name: &'static str =
                    Box::leak(format!("{side}-{}{again}", number.id).into_boxed_str());
                cases.push(changed(code, name, caught, base, move |f| change(f, size)));
            }
        }
    }
    cases
}

#[test]
fn cases_are_just_on_each_side() {
    let suite = urdd::suite::carried().expect("the suite reads");
    let caught: BTreeMap<String, bool> =
        suite.all_cases().map(|case| (case.id(), case.kind == CaseKind::Invalid)).collect();
    for number in list() {
        let id = number.id;
        assert!(!number.sides.is_empty(), "{id}: no cases, and no reason");
        for sides in &number.sides {
            match sides {
                Sides::Made { at, beyond, within, band, .. } => {
                    let unit: f64 = if *at >= 2.0 { 1.0 } else { 0.0 };
                    let near = |size: f64| (size - at).abs() <= unit.max(JUST * at.abs());
                    let just = (near(*beyond) && near(*within)) == band.is_empty();
                    let just = just && beyond != within;
                    assert!(just, "{id}: {beyond} and {within} are not just beside {at}");
                    let between = beyond.min(*within) <= *at && *at <= beyond.max(*within);
                    assert!(between, "{id}: both are on one side of {at}");
                }
                Sides::Cases { beyond, within } => {
                    assert_eq!(caught.get(*beyond), Some(&true), "{id}: {beyond}");
                    assert!(caught.contains_key(*within), "{id}: {within}");
                }
                Sides::Elsewhere(why) => assert!(why.len() > 20, "{id}: say why"),
            }
        }
    }
}
