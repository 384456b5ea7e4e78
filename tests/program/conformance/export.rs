//! `urdd conformance export`: a suite for programs in any language.

use std::fs;

use serde_json::Value;

use crate::conformance::{conformance, stderr};

#[test]
fn everything_that_is_listed_is_there() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let out = folder.path().join("suite");
    let shown = out.to_str().expect("UTF-8");
    let output = conformance(&["export", shown]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = fs::read(out.join("suite.json")).expect("suite.json");
    let list: Value = serde_json::from_slice(&text).expect("JSON");
    let cases = list["cases"].as_array().expect("a list");
    assert!(cases.len() > 500);
    for case in cases {
        let place = out.join(case["folder"].as_str().expect("a folder"));
        assert!(place.is_dir(), "{case}");
    }
    let named = |id: &str| {
        let found = cases.iter().find(|case| case["id"] == id);
        found.unwrap_or_else(|| panic!("no {id}"))
    };
    let valid = named("valid/gripper");
    assert_eq!(valid["verdict"], "accept");
    let meshes = "valid/gripper/mesh_modules/plain_meshes_module/meshes/stl";
    assert!(out.join(meshes).is_dir());
    let wrong = named("DOF001/joint-missing");
    assert_eq!(
        (&wrong["kind"], &wrong["verdict"]),
        (&"invalid".into(), &"reject".into())
    );
    assert_eq!(wrong["findings"][0]["code"], "DOF001");
    assert!(out.join("robots/gripper.urdf").is_file());
    assert!(out.join("README.md").is_file());
    for refused in [
        "KIN001/poses-beyond-numbers",
        "URD005/link-held-by-two-joints",
    ] {
        assert!(
            out.join("refused")
                .join(format!("{refused}.urdf"))
                .is_file()
        );
    }

    // Other people's files are never overwritten.
    let again = conformance(&["export", shown]);
    assert_eq!(again.status.code(), Some(2));
    assert!(stderr(&again).contains("not empty"), "{}", stderr(&again));
}
