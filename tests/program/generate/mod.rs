//! The generator, compared with the validator and with the other producers.

mod batch;
mod core;
mod edits;
mod hostile;
mod interrupted;
mod learned;
mod mesh_formats;
mod named_configurations;
mod outside;
mod packages;
mod pieces;
mod shapes;
mod slivers;
mod stage_versions;
mod strict;
mod writing;
mod xacro;

use std::path::Path;
use std::process::Command;

use serde_json::Value;
pub use testkit::files::below as bytes_below;
pub use testkit::robots::our_robots;
use urdd_validate::settings::Settings;
use urdd_validate::{rules, validate_with};

/// An STL file as text: one triangle, whose third corner determines whether it has an area.
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
    let report = serde_json::to_value(run.report).unwrap();
    let findings = report["urdds"][0]["findings"].as_array().unwrap().iter();
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    findings
        .map(|found| (text(&found["code"]), text(&found["severity"]), text(&found["message"])))
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
