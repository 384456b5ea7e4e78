//! Clause 5.12, the one table of tolerances: its numbers are those of the clauses that it names, and so are those that the
//! validator compares by.

use std::collections::BTreeSet;

use super::{list, spec};
use urdd_findings::code::Code;
use urdd_validate::tolerance::*;

/// Each tolerance of `tolerance.rs`, and the clause that states it.
const OF: &[(&str, f64, &str)] = &[
    ("POSITION_OF_REACH", POSITION_OF_REACH, "5.6"),
    ("ROTATION", ROTATION, "5.6"),
    ("NUMBER_RELATIVE", NUMBER_RELATIVE, "5.6"),
    ("NUMBER_ABSOLUTE", NUMBER_ABSOLUTE, "5.6"),
    ("UNIT_NORM", UNIT_NORM, "6.3.4"),
    ("LEAST_REACH", LEAST_REACH, "5.6"),
    ("MIMIC_LIMIT", MIMIC_LIMIT, "6.1.7"),
    ("INERTIA_DEFINITE", INERTIA_DEFINITE, "6.1.7"),
    ("INERTIA_TRIANGLE", INERTIA_TRIANGLE, "6.1.7"),
    ("MESH_VERTEX", MESH_VERTEX, "7.6.1"),
    ("PLACING", PLACING, "7.6.1"),
    ("PLACING_RELATIVE", PLACING_RELATIVE, "7.6.1"),
    ("PIECE_OUT_OF_HULL", PIECE_OUT_OF_HULL, "7.10"),
    ("PIECE_BARELY_OUT_OF_HULL", PIECE_BARELY_OUT_OF_HULL, "7.10"),
    ("SPLINTER", SPLINTER, "7.10"),
    ("STL_NORMAL", STL_NORMAL, "7.6"),
    ("PRIMITIVE_SAG", PRIMITIVE_SAG, "7.8"),
    ("PRIMITIVE_AREA", PRIMITIVE_AREA, "7.8"),
    ("COVER_WITHOUT_PROMISE", COVER_WITHOUT_PROMISE, "7.10"),
    ("HULL_IN_VOLUME", HULL_IN_VOLUME, "8.2"),
    ("NEEDLESSLY_LARGE_BOX", NEEDLESSLY_LARGE_BOX, "8.2"),
    ("NEEDLESSLY_LARGE_SPHERE", NEEDLESSLY_LARGE_SPHERE, "8.2"),
    ("DISTANCE", DISTANCE, "8.5"),
    ("LEGACY_SPHERE_SHORTFALL", LEGACY_SPHERE_SHORTFALL, "10.5"),
    ("CLOSED", CLOSED, "6.8.4"),
    ("LEAST_SUM", LEAST_SUM, "6.8.5"),
    ("LOOSE", LOOSE, "6.8.4"),
    ("SPHERE_IN_SPHERE", SPHERE_IN_SPHERE, "8.9.3"),
    ("SPHERES_COVER", SPHERES_COVER, "8.9.4"),
    ("FIT_LENGTH", FIT_LENGTH, "8.9.5"),
    ("FIT_LENGTH_FAR", FIT_LENGTH_FAR, "8.9.5"),
    ("FIT_FRACTION", FIT_FRACTION, "8.9.5"),
];

/// The rows of the table: the clauses, the tolerance, and the rules.
fn rows() -> Vec<(Vec<String>, String, String)> {
    let text = std::fs::read_to_string(testkit::repository().join("SPEC.md")).expect("SPEC.md");
    let table = text.split("**5.12 ").nth(1).and_then(|rest| rest.split("\n## ").next());
    let lines = table.expect("clause 5.12").lines().filter(|line| line.starts_with("| ")).skip(1);
    let rows = lines.map(|line| {
        let cells: Vec<&str> = line.trim_matches(['|', ' ']).split(" | ").collect();
        let [what, tolerance, rules] = cells[..] else { panic!("{line}: three cells") };
        let (_, clauses) = what.rsplit_once(": ").expect("clauses");
        let clauses = clauses.split(", ").map(str::to_owned).collect();
        (clauses, tolerance.to_owned(), rules.to_owned())
    });
    rows.collect()
}

#[test]
fn the_table_says_what_its_clauses_say() {
    let (list, rows) = (list(), rows());
    assert!(rows.len() > 30, "{} rows", rows.len());
    for (clauses, tolerance, rules) in &rows {
        for numeral in spec::numerals(tolerance, &BTreeSet::new()) {
            for clause in clauses {
                let states = list.iter().filter(|number| number.clause == clause);
                let mut states = states.flat_map(|number| number.written.split([' ', '*']));
                assert!(states.any(|part| part == numeral), "{clause} does not say {numeral}");
            }
        }
        for code in rules.split(", ").flat_map(|codes| codes.split(" to ")) {
            assert!(Code::parse(code).is_some(), "{code} is no rule");
        }
    }
}

#[test]
fn every_tolerance_of_the_validator_is_in_the_table() {
    let source = include_str!("../../../crates/urdd-validate/src/tolerance.rs");
    let names =
        source.lines().filter_map(|line| line.strip_prefix("pub const ")?.split_once(": f64"));
    let names: Vec<&str> = names.map(|(name, _)| name).collect();
    let known: Vec<&str> = OF.iter().map(|(name, ..)| *name).collect();
    assert_eq!(names, known, "each tolerance of tolerance.rs, with the clause that states it");
    let (list, rows) = (list(), rows());
    for (name, value, clause) in OF {
        assert!(rows.iter().any(|(clauses, ..)| clauses.iter().any(|one| one == clause)), "{name}");
        let near = |stated: f64| (stated - value).abs() <= 1e-6 * value;
        let is_stated = list.iter().any(|number| number.clause == *clause && near(number.value));
        assert!(is_stated, "{name}: {clause} does not say {value}");
    }
}
