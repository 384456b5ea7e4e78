//! What became of a rule: its outcome, and what it found.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::code::Code;
use super::description::Description;
use super::finding::{Finding, Findings};
use super::part::{Faulted, NotVerified, Scope};
use super::skip::SkipReason;
use urdd_directory::position::Position;
use urdd_format::report::{Place, Severity};

/// The outcome of a rule.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// It ran and found nothing.
    Passed,
    /// It ran and found something.
    Failed,
    /// It did not run to its end, for this reason.
    Skipped(SkipReason),
    /// The rule itself is faulty; the message says how.
    Crashed(String),
}

/// A rule and its outcome.
pub struct Check {
    /// What the rule says of itself.
    pub rule: &'static Description,
    /// Severity of its findings: the rule's, unless settings change it.
    pub severity: Severity,
    /// Its outcome.
    pub outcome: Outcome,
    /// Its findings.
    pub findings: Vec<Finding>,
    /// Which of these follow from findings of other rules.
    pub effects: Vec<FollowsFrom>,
    /// The parts of the robot that it did not verify.
    pub not_verified: Vec<NotVerified>,
    /// The parts with findings.
    pub faulted: Faulted,
    /// The parts that it was to judge.
    pub scope: Scope,
}

/// A finding of a rule that goes away when the fault of another one is mended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FollowsFrom {
    /// Where it is.
    pub at: Position,
    /// What it says.
    pub message: String,
    /// The finding that it follows from: its rule, and where it is.
    pub cause: (Code, Position),
}

impl Check {
    /// What a rule found.
    pub fn new(rule: &'static Description, outcome: Outcome, findings: Vec<Finding>) -> Self {
        Check {
            rule,
            severity: rule.severity,
            outcome,
            findings,
            effects: Vec::new(),
            not_verified: Vec::new(),
            faulted: Faulted::default(),
            scope: Scope::default(),
        }
    }

    /// All places of its findings, each with what it says.
    pub fn said(&self) -> impl Iterator<Item = (&Place, &str)> {
        self.findings.iter().flat_map(Finding::said)
    }

    /// A rule that does not run.
    pub fn skipped(rule: &'static Description, reason: SkipReason) -> Self {
        Check::new(rule, Outcome::Skipped(reason), Vec::new())
    }

    /// The result of a rule's check, whatever it judges. `None` from it without a reason given to [`Findings::skip`] is a
    /// fault of the rule. Places are left as the rule gave them.
    pub fn caught(
        rule: &'static Description,
        findings: &mut Findings,
        check: impl FnOnce(&mut Findings) -> Option<()>,
    ) -> Check {
        let ran = catch_unwind(AssertUnwindSafe(|| check(findings)));
        let completed = match ran {
            Ok(completed) => completed.is_some(),
            Err(panic) => {
                let message = panic_message(&*panic);
                return Check::new(rule, Outcome::Crashed(message), Vec::new());
            }
        };
        let undeclared = !completed && findings.skipped().is_none();
        if undeclared && cfg!(debug_assertions) {
            let message =
                format!("{} takes something that it does not declare in `needs`", rule.code);
            return Check::new(rule, Outcome::Crashed(message), Vec::new());
        }
        let undeclared = || undeclared.then_some(SkipReason::UndeclaredNeed);
        let nothing_left = || findings.scope().nothing_left().map(SkipReason::Failed);
        let skipped = findings.skipped().cloned();
        let skipped = skipped.or_else(undeclared).or_else(nothing_left);
        let not_verified = findings.scope().not_verified();
        let (scope, faulted) = (findings.scope().afresh(), findings.faulted().clone());
        let mut found = findings.take();
        found.iter_mut().for_each(worst_first);
        let outcome = match (found.is_empty(), skipped) {
            (false, _) => Outcome::Failed,
            (true, Some(reason)) => Outcome::Skipped(reason),
            (true, None) => Outcome::Passed,
        };
        Check { not_verified, scope, faulted, ..Check::new(rule, outcome, found) }
    }
}

/// The message of a panic.
pub(super) fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "unknown".to_owned())
}

/// Puts the worst place of a finding first, by magnitude.
pub(super) fn worst_first(finding: &mut Finding) {
    // A magnitude that is not finite is the worst.
    let size = |place: &Place| match &place.magnitude {
        None => f64::NEG_INFINITY,
        Some(magnitude) => magnitude.value.unwrap_or(f64::INFINITY),
    };
    finding.more.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let Some(worst) = finding.more.first_mut() else {
        return;
    };
    if size(worst) > size(&finding.place) {
        std::mem::swap(&mut finding.place, worst);
        if let Some(message) = finding.place.message.take() {
            let first = std::mem::replace(&mut finding.message, message);
            for other in &mut finding.more {
                match &other.message {
                    None => other.message = Some(first.clone()),
                    Some(same) if *same == finding.message => other.message = None,
                    Some(_) => {}
                }
            }
        }
        // Sorts the former first place in among the others.
        finding.more.sort_by(|a, b| size(b).total_cmp(&size(a)));
    }
}
