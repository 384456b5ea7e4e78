//! Annex C of SPEC.md: a URDD that the validator accepts, of class Core.

use std::fs;

#[test]
fn the_example_is_valid() {
    let folder = testkit::repository().join("examples/one_joint");
    let urdd = fs::read_to_string(folder.join("urdd.json")).expect("urdd.json");
    assert!(urdd.contains("\"conformance_class\": \"Core\""));
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_urdd"))
        .arg("validate")
        .arg(&folder)
        .output()
        .expect("urdd runs");
    let report = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{report}");
    assert!(report.contains("0 errors, 1 warning"), "{report}");
}
