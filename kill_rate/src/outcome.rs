//! What the validator says of a change.

use std::path::Path;

use super::mutation::Description;
use urdd_validate::code::Code;
use urdd_validate::engine::{Check, Outcome as RuleOutcome};
use urdd_validate::rule::{Phase, Rule, Severity};
use urdd_validate::settings::Settings;
use urdd_validate::validate_with;

/// What became of a change.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// There is an error; the rules that found one.
    Noticed(Vec<Code>),
    /// There is a warning or an information, and no error; the rules that found one.
    Warned(Vec<Code>),
    /// Nothing is found.
    Missed,
    /// A rule crashed.
    Crashed(Code),
    /// The URDD cannot be examined any more, and the validator says so.
    Unreadable,
}

impl Outcome {
    /// Whether the validator says anything.
    pub fn is_noticed(&self) -> bool {
        matches!(
            self,
            Outcome::Noticed(_) | Outcome::Warned(_) | Outcome::Unreadable
        )
    }
}

/// A change, and what became of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trial {
    /// The change.
    pub change: Description,
    /// What the plain run says.
    pub plain: Outcome,
    /// What the deep run says, where there is one: of what the plain run notices, the same.
    pub deep: Option<Outcome>,
}

/// What the validator says of a URDD. Rules of late phases, which may take long, run only where the others find no
/// error: a rule counts on what earlier ones have found, never the other way about.
pub(crate) fn judge(path: &Path, rules: &[&'static Rule], settings: &Settings) -> Outcome {
    let early: Vec<&'static Rule> = rules
        .iter()
        .copied()
        .filter(|rule| rule.phase <= Phase::References)
        .collect();
    let outcome = judge_by(path, &early, settings);
    match outcome {
        Outcome::Noticed(_) | Outcome::Crashed(_) | Outcome::Unreadable => outcome,
        Outcome::Warned(_) | Outcome::Missed => judge_by(path, rules, settings),
    }
}

fn judge_by(path: &Path, rules: &[&'static Rule], settings: &Settings) -> Outcome {
    let examined = match validate_with(&[path], settings, rules) {
        Ok(mut report) => match report.subjects.pop().map(|subject| subject.result) {
            Some(Ok(examined)) => examined,
            _ => return Outcome::Unreadable,
        },
        Err(_) => return Outcome::Unreadable,
    };
    let crashed = |check: &&Check| matches!(check.outcome, RuleOutcome::Crashed(_));
    if let Some(check) = examined.checks.iter().find(crashed) {
        return Outcome::Crashed(check.rule.code);
    }
    let codes = |of: &dyn Fn(Severity) -> bool| -> Vec<Code> {
        let found = examined
            .checks
            .iter()
            .filter(|check| !check.findings.is_empty() && of(check.severity));
        found.map(|check| check.rule.code).collect()
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
