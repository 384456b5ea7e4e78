//! The commands that run the conformance suite. Its crate's tests judge the cases.

#[cfg(unix)]
mod again;
mod export;
mod producer;
#[cfg(unix)]
mod unreadable;
#[cfg(unix)]
mod validator;

use std::process::Output;

use serde_json::Value;

/// Runs `urdd conformance` in the repository's folder.
fn conformance(arguments: &[&str]) -> Output {
    crate::program::output(&[&["conformance"], arguments].concat(), testkit::repository())
}

/// The result that a command writes as JSON, and its exit status.
fn result(arguments: &[&str]) -> (i32, Value) {
    let output = conformance(arguments);
    let result = serde_json::from_slice(&output.stdout);
    let result = result.unwrap_or_else(|e| panic!("{e}: {}", stderr(&output)));
    (output.status.code().expect("an exit status"), result)
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
