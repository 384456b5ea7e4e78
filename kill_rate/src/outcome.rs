//! The validator's verdict on a mutation.

use std::collections::BTreeSet;
use std::path::Path;

use super::mutation::Description;
use urdd_findings::description::Phase;
use urdd_format::report::{Severity, Status, Verdict};
use urdd_validate::code::Code;
use urdd_validate::rule::Rule;
use urdd_validate::settings::Settings;
use urdd_validate::validate_with;

/// Outcome of a mutation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// At least one error; the rules that found errors.
    Noticed(Vec<Code>),
    /// Warnings or infos but no error; the rules that found them.
    Warned(Vec<Code>),
    /// No findings.
    Missed,
    /// A rule crashed.
    Crashed(Code),
    /// The validator reports that the URDD cannot be read.
    Unreadable,
}

impl Outcome {
    /// Whether the validator detects the mutation.
    pub fn is_noticed(&self) -> bool {
        matches!(self, Outcome::Noticed(_) | Outcome::Warned(_) | Outcome::Unreadable)
    }
}

/// A mutation and its outcome.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trial {
    /// The mutation.
    pub change: Description,
    /// Outcome of the plain run.
    pub plain: Outcome,
    /// Outcome of the deep run, if any. For mutations that the plain run detects, the same.
    pub deep: Option<Outcome>,
}

/// Runs the validator on a URDD. Slow rules of late phases run only if the earlier ones find no error: late rules
/// depend on earlier ones, never the reverse.
pub(crate) fn judge(path: &Path, rules: &[&'static Rule], settings: &Settings) -> Outcome {
    let early: Vec<&'static Rule> =
        rules.iter().copied().filter(|rule| rule.phase <= Phase::References).collect();
    let outcome = judge_by(path, &early, settings);
    match outcome {
        Outcome::Noticed(_) | Outcome::Crashed(_) | Outcome::Unreadable => outcome,
        Outcome::Warned(_) | Outcome::Missed => judge_by(path, rules, settings),
    }
}

fn judge_by(path: &Path, rules: &[&'static Rule], settings: &Settings) -> Outcome {
    let urdd = match validate_with(&[path], settings, rules) {
        Ok(mut run) => match run.report.urdds.pop() {
            Some(urdd) if urdd.verdict != Verdict::Unreadable => urdd,
            _ => return Outcome::Unreadable,
        },
        Err(_) => return Outcome::Unreadable,
    };
    let mut checks = urdd.checks.iter();
    let crashed = checks.find(|check| check.status == Status::Crashed);
    if let Some(code) = crashed.and_then(|check| Code::parse(&check.code)) {
        return Outcome::Crashed(code);
    }
    let codes = |of: &dyn Fn(Severity) -> bool| -> Vec<Code> {
        let found = urdd.findings.iter().filter(|finding| of(finding.severity));
        let codes: BTreeSet<_> = found.filter_map(|finding| Code::parse(&finding.code)).collect();
        codes.into_iter().collect()
    };
    let errors = codes(&|severity| severity == Severity::Error);
    if !errors.is_empty() {
        return Outcome::Noticed(errors);
    }
    let others = codes(&|_| true);
    match others.is_empty() {
        true => Outcome::Missed,
        false => Outcome::Warned(others),
    }
}
