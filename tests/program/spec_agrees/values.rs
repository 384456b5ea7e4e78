//! The numbers in SPEC.md's tables of values are those of `conformance/vectors`.

use std::fs;

use serde_json::Value;

use super::spec;

fn vectors(name: &str) -> Value {
    let path = format!("{}/conformance/vectors/{name}", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&fs::read_to_string(path).expect("vectors")).expect("JSON")
}

/// The numbers in each cell of a table's rows, in order.
fn rows(header: &str) -> Vec<Vec<Vec<f64>>> {
    let text = spec();
    let rows: Vec<Vec<Vec<f64>>> = text
        .lines()
        .skip_while(|line| !line.starts_with(header))
        .skip(2)
        .take_while(|line| line.starts_with('|'))
        .map(|line| line.trim_matches('|').split('|').map(numbers).collect())
        .collect();
    assert!(rows.len() >= 5, "{header}: {} rows", rows.len());
    rows
}

/// The numbers in a text: "(1, -2.5e-3)" and words between them.
fn numbers(text: &str) -> Vec<f64> {
    text.split([' ', ',', '(', ')']).filter_map(|word| word.parse().ok()).collect()
}

fn flat(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list");
    list.iter().map(|x| x.as_f64().expect("a number")).collect()
}

/// Whether one of the cases has the values of the cells in these keys.
fn assert_known(cases: &Value, keys: &[&[&str]], row: &[Vec<f64>]) {
    let known = cases.as_array().expect("a list").iter().any(|case| {
        let cells = keys.iter().map(|keys| {
            let values = keys.iter().map(|key| &case[*key]);
            values.flat_map(flat).collect::<Vec<f64>>()
        });
        cells.eq(row.iter().cloned())
    });
    assert!(known, "{row:?} is in no vector");
}

#[test]
fn rotations() {
    let vectors = vectors("rotations.json");
    let rows = rows("| roll, pitch, yaw |");
    let (locked, angles): (Vec<_>, Vec<_>) = rows.iter().partition(|row| row[0].len() == 6);
    for row in &angles {
        assert_known(&vectors["rpy"], &[&["rpy"], &["quaternion_wxyz"]], row);
    }
    assert_eq!(locked.len(), 1);
    let keys: &[&[&str]] = &[&["rpy", "same_as_rpy"], &["quaternion_wxyz"]];
    assert_known(&vectors["gimbal_lock"], keys, locked[0]);
}

#[test]
fn in_plane_bases() {
    let vectors = vectors("in_plane_bases.json");
    for row in rows("| `axis` of the URDF |") {
        assert_known(&vectors["bases"], &[&["axis"], &["x"], &["y"]], &row);
    }
}

#[test]
fn sampled_numbers() {
    let vectors = vectors("sampled_configurations.json");
    let known = vectors["u"].as_array().expect("a list");
    for row in rows("| k | i | u(k, i) |") {
        let row = row.concat();
        let of = |case: &Value| ["k", "i", "u"].map(|key| case[key].as_f64());
        let found = known.iter().any(|case| of(case) == [row[0], row[1], row[2]].map(Some));
        assert!(found, "{row:?} is in no vector");
    }
}

#[test]
fn the_example_of_a_rotation_vector() {
    let vectors = vectors("sampled_configurations.json");
    let text = spec();
    let example = text.split("With u = ").nth(1).expect("the example");
    let example = example.lines().next().expect("a line");
    let (u, vector) = example.split_once("it is").expect("what it is");
    let row = [numbers(u), numbers(vector.trim_end_matches('.'))];
    assert_known(&vectors["rotations"], &[&["u"], &["rotation_vector"]], &row);
}
