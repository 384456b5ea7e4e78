//! A short list of the errors of a URDD.

use std::collections::BTreeMap;
use std::path::Path;

use super::{ValidateError, validate};
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_findings::code::Code;
use urdd_findings::description::Severity;
use urdd_findings::settings::Settings;

/// The rules that find errors in a URDD, each with its number of findings, as text; empty if there are none. For a URDD
/// that cannot be examined, the reason.
///
/// # Errors
/// If cancelled.
pub fn find_errors(path: &Path, cancellation: &Cancellation) -> Result<Vec<String>, Cancelled> {
    let usual = Settings { cancellation: cancellation.clone(), ..Settings::default() };
    let run = match validate(&[path], &usual) {
        Ok(run) => run,
        Err(ValidateError::Cancelled(cancelled)) => return Err(cancelled),
        Err(error) => return Ok(vec![error.to_string()]),
    };
    let mut codes: BTreeMap<Option<Code>, usize> = BTreeMap::new();
    for urdd in run.report.urdds {
        if let Some(reason) = urdd.reason {
            return Ok(vec![reason]);
        }
        let errors = urdd.findings.iter();
        for finding in errors.filter(|finding| finding.severity == Severity::Error) {
            *codes.entry(Code::parse(&finding.code)).or_default() += 1;
        }
    }
    let codes = codes.into_iter().filter_map(|(code, count)| Some((code?, count)));
    let texts = codes.map(|(code, count)| match count {
        1 => format!("{code} (1 finding)"),
        _ => format!("{code} ({count} findings)"),
    });
    Ok(texts.collect())
}
