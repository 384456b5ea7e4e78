//! Verifies the rates of a URDD's self-collision model, without validating the rest.

use std::collections::BTreeSet;
use std::path::Path;

use super::rule::Rule;
use super::{rules, validate_with};
use urdd_findings::code::Code;
use urdd_findings::settings::Settings;
use urdd_format::report::Status;

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
    let Some(urdd) = urdd else {
        return ModelVerdict::NotVerified(Vec::new());
    };
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
