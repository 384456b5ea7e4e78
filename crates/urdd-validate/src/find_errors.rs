//! Finds the errors of a URDD, in a few words.

use std::collections::BTreeMap;
use std::path::Path;

use super::code::Code;
use super::rule::Severity;
use super::settings::Settings;
use super::{ValidateError, validate};
use urdd_directory::cancellation::{Cancellation, Cancelled};

/// The rules that find errors in a URDD, with their numbers of findings, in words; empty if it passes. The reason, if
/// it cannot be examined.
///
/// # Errors
/// If it is cancelled.
pub fn find_errors(path: &Path, cancellation: &Cancellation) -> Result<Vec<String>, Cancelled> {
    let usual = Settings {
        cancellation: cancellation.clone(),
        ..Settings::default()
    };
    let run = match validate(&[path], &usual) {
        Ok(run) => run,
        Err(ValidateError::Cancelled(cancelled)) => return Err(cancelled),
        Err(error) => return Ok(vec![error.to_string()]),
    };
    let mut codes: BTreeMap<Code, usize> = BTreeMap::new();
    for subject in &run.subjects {
        let examined = match &subject.result {
            Ok(examined) => examined,
            Err(error) => return Ok(vec![error.to_string()]),
        };
        let errors = examined.checks.iter();
        let errors = errors.filter(|check| check.severity == Severity::Error);
        for check in errors.filter(|check| !check.findings.is_empty()) {
            *codes.entry(check.rule.code).or_default() += check.findings.len();
        }
    }
    let told = codes.iter().map(|(code, count)| match count {
        1 => format!("{code} (1 finding)"),
        _ => format!("{code} ({count} findings)"),
    });
    Ok(told.collect())
}
