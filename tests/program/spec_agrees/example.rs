//! Annex B of SPEC.md: a whole URDD, printed from its files, so that the two cannot differ.

use std::fmt::Write;
use std::fs;

/// The URDD.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/annex_b/one_joint");

/// The printed files, and the language of each. Other `module.yaml` files hold what their `module.json` holds.
const FILES: &[(&str, &str)] = &[
    ("one_joint.urdf", "xml"),
    ("urdd.json", "json"),
    ("urdf_module/module.json", "json"),
    ("dof_module/module.json", "json"),
    ("dof_module/module.yaml", "yaml"),
    ("chain_module/module.json", "json"),
    ("connections_module/module.json", "json"),
    ("bounds_module/module.json", "json"),
];

pub fn text() -> String {
    let mut text = String::new();
    for (path, language) in FILES {
        let file = fs::read_to_string(format!("{FOLDER}/{path}")).expect("a file of the example");
        let _ = writeln!(text, "\n`{path}`\n\n```{language}\n{}\n```", file.trim_end());
    }
    text.push('\n');
    text
}

/// It is a URDD that the validator accepts, of class Core.
#[test]
fn the_example_is_valid() {
    let folder = std::path::Path::new(FOLDER);
    let urdd = fs::read_to_string(folder.join("urdd.json")).expect("urdd.json");
    assert!(urdd.contains("\"conformance_class\": \"Core\""));
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_urdd"))
        .arg("validate")
        .arg(folder)
        .output()
        .expect("urdd runs");
    let report = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{report}");
    assert!(report.contains("0 errors, 1 warning"), "{report}");
}
