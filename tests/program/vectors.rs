//! Compares urdd with `conformance/vectors`: numbers from other implementations or from closed forms. (The two about
//! forward kinematics and sampled configurations are in `tests/kinematics_figures.rs`.)

mod conventions;
mod core_modules;
mod learned;
mod loops;
mod solids;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;

/// The files, each with the tests that check it.
const FILES: &[(&str, &str)] = &[
    ("boxes_and_spheres.json", "tests/program/vectors/solids.rs"),
    ("distances.json", "tests/program/vectors/solids.rs"),
    ("forward_kinematics.json", "crates/urdd-validate/tests/validate/kinematics_figures.rs"),
    ("hulls.json", "tests/program/vectors/solids.rs"),
    ("in_plane_bases.json", "tests/program/vectors/conventions.rs"),
    ("inertia.json", "tests/program/vectors/core_modules.rs"),
    ("loops.json", "tests/program/vectors/loops.rs"),
    ("mimics.json", "tests/program/vectors/core_modules.rs"),
    ("rotations.json", "tests/program/vectors/conventions.rs"),
    ("sampled_configurations.json", "crates/urdd-validate/tests/validate/kinematics_figures.rs"),
    ("self_collision_model.json", "tests/program/vectors/learned.rs"),
    ("spheres.json", "tests/program/vectors/loops.rs"),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/vectors")
}

fn vectors<T: for<'de> Deserialize<'de>>(name: &str) -> T {
    let text = fs::read_to_string(folder().join(name)).unwrap();
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Whether numbers agree as closely as two computations in doubles can.
#[track_caller]
fn assert_near(found: &[f64], expected: &[f64], tolerance: f64, place: &str) {
    assert_eq!(found.len(), expected.len(), "{place}");
    for (found_one, expected_one) in found.iter().zip(expected) {
        let off = (found_one - expected_one).abs();
        assert!(off <= tolerance, "{place}: {found:?}, expected {expected:?}: {off:e} off");
    }
}

#[test]
fn every_file_is_held_to_and_described() {
    let mut there: BTreeSet<String> = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    assert!(there.remove("README.md"));
    let known: BTreeSet<String> = FILES.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(there, known);
    let readme = fs::read_to_string(folder().join("README.md")).unwrap();
    for (name, test) in FILES {
        assert!(readme.contains(&format!("## {name}")), "{name} is not in the README");
        let test = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(test)).unwrap();
        assert!(test.contains(name), "no test reads {name}");
    }
}
