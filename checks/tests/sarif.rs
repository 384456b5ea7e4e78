//! Our SARIF checked against its schema, and read by third-party Rust types.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn cargo(arguments: &[&str], folder: &Path) -> Vec<u8> {
    let output =
        Command::new(env!("CARGO")).args(arguments).current_dir(folder).output().expect("cargo");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.stdout.is_empty(), "{arguments:?}: {said}");
    output.stdout
}

/// The program, built in the repository: elsewhere, cargo would not see its `.cargo/config.toml`, and build all of it
/// once more with other flags.
fn program() -> PathBuf {
    let built = Command::new(env!("CARGO"))
        .args(["build", "--quiet", "--bin", "urdd"])
        .current_dir(repository())
        .status();
    assert!(built.expect("cargo").success());
    repository().join("target/debug/urdd").canonicalize().expect("the program")
}

fn sarif(folder: &Path, arguments: &[&str]) -> Value {
    let output = Command::new(program())
        .args(["validate", "--format", "sarif"])
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program runs");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder") {
        let entry = entry.expect("an entry");
        let target = to.join(entry.file_name());
        match entry.path().is_dir() {
            true => copy(&entry.path(), &target),
            false => drop(fs::copy(entry.path(), target).expect("a file")),
        }
    }
}

/// Robots: a valid one; an invalid one, whose names must be escaped; one with a warning.
fn robots() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let arm = repository().join("examples/urdds/arm");
    let robots = folder.path().join("robots");
    copy(&arm, &robots.join("good"));
    let odd = robots.join("né #1\u{1} <\"&'>");
    copy(&arm, &odd);
    let root = fs::read_to_string(odd.join("urdd.json")).expect("a file");
    let mut root: Value = serde_json::from_str(&root).expect("JSON");
    root["robot_name"] = "a\u{1}<b>&\"]]>\u{fffe}[x](y)".into();
    fs::write(odd.join("urdd.json"), root.to_string()).expect("written");
    copy(&arm, &robots.join("arms/stray"));
    fs::write(robots.join("arms/stray/dof_module/notes"), "").expect("written");
    folder
}

/// The schema of SARIF 2.1.0, as OASIS published it. It is not part of this repository: the package of serde-sarif
/// contains it.
fn sarif_schema() -> Value {
    let metadata = ["metadata", "--format-version=1", "--locked"];
    let metadata = cargo(&metadata, Path::new(env!("CARGO_MANIFEST_DIR")));
    let metadata: Value = serde_json::from_slice(&metadata).expect("cargo's metadata");
    let packages = metadata["packages"].as_array().expect("a list");
    let package =
        packages.iter().find(|package| package["name"] == "serde-sarif").expect("serde-sarif");
    let manifest = PathBuf::from(package["manifest_path"].as_str().expect("a path"));
    let file = manifest.with_file_name("src").join("schema.json");
    let mut schema: Value = serde_json::from_str(&fs::read_to_string(file).expect("the schema"))
        .expect("the schema is JSON");
    // The published pattern for a language is not a valid regular expression.
    for place in ["run", "toolComponent"] {
        let language = schema.pointer_mut(&format!("/definitions/{place}/properties/language"));
        let language = language.and_then(Value::as_object_mut).expect("an object");
        assert!(language.remove("pattern").is_some());
    }
    assert!(schema["title"].as_str().is_some_and(|t| t.contains("2.1.0")));
    schema
}

#[test]
fn sarif_fits_its_schema() {
    let schema = jsonschema::draft7::options()
        .should_validate_formats(true)
        .build(&sarif_schema())
        .expect("a schema");
    let robots = robots();
    let stale = "[[ignore]]\ncode = \"DIR020\"\npath = \"nobody/**\"\nreason = \"x\"";
    fs::write(robots.path().join("urdd.toml"), stale).expect("written");
    let repository = repository();
    for (folder, arguments, findings) in [
        (robots.path(), &["robots"] as &[&str], true),
        (robots.path(), &["robots/good"], false),
        (robots.path(), &["robots", "--with-crashing-rule"], true),
        (&repository, &["examples/urdds"], true),
    ] {
        let log = sarif(folder, arguments);
        let errors: Vec<String> = schema.iter_errors(&log).map(|e| e.to_string()).collect();
        assert_eq!(errors, [""; 0], "{arguments:?}");
        let results = log["runs"][0]["results"].as_array().expect("a list");
        assert_eq!(!results.is_empty(), findings, "{arguments:?}");
        // And third-party types accept it.
        let _: serde_sarif::sarif::Sarif = serde_json::from_value(log).expect("SARIF");
    }
}
