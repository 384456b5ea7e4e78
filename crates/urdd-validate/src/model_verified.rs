//! Verifies the rates of a URDD's self-collision model, and nothing else.

use std::collections::BTreeSet;
use std::path::Path;

use super::code::Code;
use super::engine::Outcome;
use super::rule::Rule;
use super::settings::Settings;
use super::{rules, validate_with};

/// Result of counting again how often a model is right (SPEC 8.8.9 to 8.8.12).
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ModelVerdict {
    /// The stated rates are confirmed.
    Verified,
    /// They are not: the rules that found it.
    Refuted(Vec<Code>),
    /// They could not be verified, for these reasons.
    NotVerified(Vec<String>),
}

/// Runs the rules that verify the self-collision model of the URDD at `path`, and the rules that those need.
pub fn verify_model(path: &Path) -> ModelVerdict {
    let all = rules::all();
    let mut wanted = BTreeSet::from([Code::LRN010, Code::LRN011]);
    let mut open: Vec<Code> = wanted.iter().copied().collect();
    while let Some(code) = open.pop() {
        let needs = all.iter().filter(|rule| rule.code == code);
        let needs = needs
            .flat_map(|rule| rule.needs)
            .flat_map(|need| need.codes());
        open.extend(needs.filter(|code| wanted.insert(*code)));
    }
    let wanted: Vec<&'static Rule> = all
        .into_iter()
        .filter(|rule| wanted.contains(&rule.code))
        .collect();
    let run = match validate_with(&[path], &Settings::default(), &wanted) {
        Ok(run) => run,
        Err(error) => return ModelVerdict::NotVerified(vec![error.to_string()]),
    };
    let examined = match run
        .subjects
        .into_iter()
        .next()
        .map(|subject| subject.result)
    {
        Some(Ok(examined)) => examined,
        Some(Err(error)) => return ModelVerdict::NotVerified(vec![error.to_string()]),
        None => return ModelVerdict::NotVerified(Vec::new()),
    };
    let failed = examined.checks.iter();
    let failed = failed.filter(|check| check.outcome == Outcome::Failed);
    let failed = failed.map(|check| check.rule.code);
    let refuted: Vec<Code> = failed.filter(|code| code.family() == "LRN").collect();
    if !refuted.is_empty() {
        return ModelVerdict::Refuted(refuted);
    }
    let whys = examined.model_not_verified();
    if whys.is_empty() && examined.crashed.is_none() {
        return ModelVerdict::Verified;
    }
    let reasons: BTreeSet<String> = whys.into_iter().map(|(_, why)| why).collect();
    ModelVerdict::NotVerified(reasons.into_iter().chain(examined.crashed).collect())
}
