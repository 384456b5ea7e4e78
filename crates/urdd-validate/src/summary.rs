//! Short answers about a URDD: which errors it has, and whether its self-collision model is as good as it says.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::rule::Rule;
use super::{ValidateError, rules, validate, validate_with};
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_findings::code::Code;
use urdd_findings::description::Severity;
use urdd_findings::settings::Settings;
use urdd_format::report::Status;

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

/// The result of recounting the rates of a model (SPEC 8.8.9 to 8.8.12).
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ModelVerdict {
    /// The stated rates are right.
    Verified,
    /// The stated rates are wrong: the codes of the rules that found it.
    Refuted(Vec<String>),
    /// The rates were not verified, for these reasons.
    NotVerified(Vec<String>),
}

/// Runs the rules that verify the self-collision model of the URDD at `path`, and the rules that they need.
pub fn verify_model(path: &Path) -> ModelVerdict {
    let all = rules::all();
    let mut wanted = BTreeSet::from([Code::LRN010, Code::LRN011]);
    let mut open: Vec<Code> = wanted.iter().copied().collect();
    while let Some(code) = open.pop() {
        let needs = all.iter().filter(|rule| rule.code == code);
        let needs = needs.flat_map(|rule| rule.needs).flat_map(|need| need.codes());
        open.extend(needs.filter(|code| wanted.insert(*code)));
    }
    let wanted: Vec<&'static Rule> =
        all.into_iter().filter(|rule| wanted.contains(&rule.code)).collect();
    let urdd = match validate_with(&[path], &Settings::default(), &wanted) {
        Ok(run) => run.report.urdds.into_iter().next(),
        Err(error) => return ModelVerdict::NotVerified(vec![error.to_string()]),
    };
    let Some(urdd) = urdd else { return ModelVerdict::NotVerified(Vec::new()) };
    let failed = urdd.checks.iter().filter(|check| check.status == Status::Failed);
    let refuted: Vec<String> =
        failed.map(|check| check.code.clone()).filter(|code| code.starts_with("LRN")).collect();
    if !refuted.is_empty() {
        return ModelVerdict::Refuted(refuted);
    }
    let open = urdd.model_not_verified.into_iter().flat_map(|open| open.reasons);
    let reasons: Vec<String> = open.chain(urdd.reason).collect();
    if reasons.is_empty() { ModelVerdict::Verified } else { ModelVerdict::NotVerified(reasons) }
}
