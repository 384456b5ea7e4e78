//! The generator, held to the validator and to the other producers.

mod batch;
mod core;
mod edits;
mod hostile;
mod interrupted;
mod learned;
mod mesh_formats;
mod outside;
mod packages;
mod pieces;
mod shapes;
mod stage_versions;
mod strict;
mod writing;
mod xacro;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use urdd_validate::rule::Severity;
use urdd_validate::settings::Settings;
use urdd_validate::{rules, validate_with};

/// An STL file as text: one triangle, whose third corner says whether it has an area.
pub fn ascii_stl(name: &str, third: &str) -> String {
    format!(
        "solid {name}\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex {third}\nendloop\nendfacet\nendsolid {name}\n"
    )
}

/// A JSON file.
pub fn read_json(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// What the validator finds: code, severity, message.
pub fn findings_of(urdd: &Path) -> Vec<(String, String, String)> {
    let run = validate_with(&[urdd.to_owned()], &Settings::default(), &rules::all()).unwrap();
    let report = serde_json::to_value(run.report(Severity::Error)).unwrap();
    let findings = report["urdds"][0]["findings"].as_array().unwrap().iter();
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    findings
        .map(|found| {
            (
                text(&found["code"]),
                text(&found["severity"]),
                text(&found["message"]),
            )
        })
        .collect()
}

/// The program, with arguments, and an environment in which no package is found.
pub fn urdd(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
    command.args(arguments);
    for name in ["ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "GAZEBO_MODEL_PATH"] {
        command.env_remove(name);
    }
    command
}

/// The robots of `conformance/robots`: their names, and their URDFs.
pub fn our_robots() -> Vec<(String, PathBuf)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/robots");
    let mut robots: Vec<(String, PathBuf)> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "urdf")
        })
        .map(|path| (path.file_stem().unwrap().to_str().unwrap().to_owned(), path))
        .collect();
    robots.sort();
    assert!(robots.len() >= 9, "{robots:?}");
    robots
}

/// Every file below a folder, by its path from there.
pub fn bytes_below(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).unwrap_or_else(|e| panic!("{}: {e}", next.display())) {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path
                    .strip_prefix(folder)
                    .unwrap()
                    .to_str()
                    .unwrap()
                    .to_owned();
                files.insert(name, fs::read(path).unwrap());
            }
        }
    }
    files
}
