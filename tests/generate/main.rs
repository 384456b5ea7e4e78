//! The generator, held to the validator and to the other producers.

#[path = "../support/mod.rs"]
mod support;

mod hostile;

use std::path::Path;

use serde_json::Value;
use urdd::report::Report;
use urdd::validate::rule::Severity;
use urdd::validate::settings::Settings;
use urdd::validate::{rules, validate_with};

/// A JSON file.
pub fn read_json(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// What the validator finds: code, severity, message.
pub fn findings_of(urdd: &Path) -> Vec<(String, String, String)> {
    let run = validate_with(&[urdd.to_owned()], &Settings::default(), &rules::all()).unwrap();
    let report = serde_json::to_value(Report::new(&run, Severity::Error)).unwrap();
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
