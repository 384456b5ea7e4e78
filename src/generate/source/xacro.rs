//! Expanding xacro files, by the program of that name.

use std::io::ErrorKind;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::generate::error::GenerateError;

/// The URDF that a xacro file makes.
///
/// # Errors
/// Where there is no such program, or it fails.
pub(super) fn expand(path: &Path, shown: &str) -> Result<String, GenerateError> {
    let failed = |reason: String| GenerateError::Xacro {
        file: shown.to_owned(),
        reason,
    };
    let output = Command::new("xacro")
        .arg(path)
        .stdin(Stdio::null())
        .output()
        .map_err(|error| match error.kind() {
            ErrorKind::NotFound => GenerateError::NoXacro {
                file: shown.to_owned(),
            },
            _ => failed(error.to_string()),
        })?;
    if !output.status.success() {
        let words = String::from_utf8_lossy(&output.stderr);
        // Below a Python traceback, the last lines say what is wrong.
        let lines: Vec<&str> = words
            .lines()
            .filter(|line| !line.trim().is_empty())
            .collect();
        let last = lines[lines.len().saturating_sub(3)..].join("; ");
        return Err(failed(if last.is_empty() {
            output.status.to_string()
        } else {
            last
        }));
    }
    String::from_utf8(output.stdout).map_err(|_| failed("what it writes is not UTF-8".to_owned()))
}
