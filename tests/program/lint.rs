//! `urdd lint` as people run it.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::output;

/// A joint whose axis is not of length 1.
const SLIDE: &str = "<joint name=\"slide\" type=\"prismatic\"><parent link=\"a\"/><child link=\"b\"/>\
    <axis xyz=\"0 0 2\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>";

fn write(folder: &Path, name: &str, text: &str) {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
    fs::write(path, text).expect("written");
}

/// A folder with a URDF.
fn slide() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let text = format!("<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/>{SLIDE}</robot>");
    write(folder.path(), "robots/slide.urdf", &text);
    folder
}

/// The codes that `urdd lint` finds in a folder.
fn codes(folder: &Path, arguments: &[&str]) -> Vec<String> {
    let output = output(
        &[&["lint", ".", "--format", "json"], arguments].concat(),
        folder,
    );
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let findings = report["urdds"][0]["findings"].as_array().expect("a list");
    let codes = findings
        .iter()
        .map(|finding| finding["code"].as_str().expect("a code"));
    codes.map(ToOwned::to_owned).collect()
}

#[test]
fn urdd_toml_names_a_baseline() {
    let folder = slide();
    let folder = folder.path();
    let all = codes(folder, &[]);
    assert!(all.contains(&"LNT012".to_owned()), "{all:?}");
    let write_baseline = |name: &str| {
        let output = output(&["lint", ".", "--write-baseline", name], folder);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
    };
    fs::create_dir(folder.join("ci")).expect("a folder");
    write_baseline("ci/known.json");
    // Its name is seen from the settings file.
    write(folder, "urdd.toml", "baseline = \"ci/known.json\"\n");
    assert_eq!(codes(folder, &[]), [""; 0]);
    write(folder, "ci/settings.toml", "baseline = \"known.json\"\n");
    assert_eq!(codes(folder, &["--config", "ci/settings.toml"]), [""; 0]);
    // The command line comes first, and a new baseline has all that is found.
    write(folder, "none.json", "{\"urdd_baseline\": 1, \"files\": {}}");
    assert_eq!(codes(folder, &["--baseline", "none.json"]), all);
    write_baseline("ci/known.json");
    assert_eq!(codes(folder, &[]), [""; 0]);
    // `validate` has the same settings, and no baseline.
    let validated = output(&["validate", "robots/slide.urdf"], folder);
    assert_ne!(validated.status.code(), Some(2), "{validated:?}");
    fs::remove_file(folder.join("ci/known.json")).expect("removed");
    let missing = output(&["lint", "."], folder);
    assert_eq!(missing.status.code(), Some(2));
    let words = String::from_utf8_lossy(&missing.stderr);
    assert!(
        words.contains("known.json: there is no such file"),
        "{words}"
    );
}

#[test]
fn a_fault_in_urdd_toml_is_said_with_its_place() {
    let folder = slide();
    for (text, place) in [
        ("\ncolour = true\n", ":2:1: "),
        ("[severity]\nLNT999 = \"info\"\n", ":2:1: "),
        ("[[ignore]]\npath = \"**\"\nreason = \" \"\n", ":3:10: "),
    ] {
        write(folder.path(), "urdd.toml", text);
        let output = output(&["lint", "."], folder.path());
        assert_eq!(output.status.code(), Some(2), "{text}");
        let words = String::from_utf8_lossy(&output.stderr);
        assert!(words.contains(&format!("urdd.toml{place}")), "{words}");
    }
}
