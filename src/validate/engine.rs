//! Runs the rules over a URDD: phase by phase, each rule only when what it needs is sound, a rule
//! that crashes caught.

use std::any::Any;
use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::code::Code;
use super::context::Context;
use super::finding::{Finding, Findings};
use super::locate::locate;
use super::rule::{Need, Rule, Severity};
use super::skip::SkipReason;
use crate::format::registry::{ModuleKind, Profile};

/// What became of a rule on one URDD.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// It ran and found nothing.
    Passed,
    /// It ran and found something.
    Failed,
    /// It did not run, for this reason.
    Skipped(SkipReason),
    /// It ran into a fault of its own, with this message.
    Crashed(String),
}

/// A rule and what became of it.
pub struct Check {
    /// The rule.
    pub rule: &'static Rule,
    /// How bad its findings are: the rule's word, unless settings have another.
    pub severity: Severity,
    /// What became of it.
    pub outcome: Outcome,
    /// What it found.
    pub findings: Vec<Finding>,
}

impl Check {
    pub(super) fn new(rule: &'static Rule, outcome: Outcome, findings: Vec<Finding>) -> Self {
        Check {
            rule,
            severity: rule.severity,
            outcome,
            findings,
        }
    }
}

/// What became of rules, by code.
pub(super) type Outcomes = HashMap<Code, Outcome>;

/// Runs rules by one description of the robot. `outcomes` says what became of rules that ran
/// before, and takes what becomes of these.
pub(super) fn run_all(
    context: &Context,
    mut rules: Vec<&'static Rule>,
    outcomes: &mut Outcomes,
) -> Vec<Check> {
    rules.sort_by_key(|rule| (rule.phase, rule.code));
    let mut checks = Vec::with_capacity(rules.len());
    // A rule may need one of the same phase with a higher code: those that wait go round again.
    let mut waiting = rules;
    while !waiting.is_empty() {
        let codes: Vec<Code> = waiting.iter().map(|rule| rule.code).collect();
        let before = waiting.len();
        let mut later = Vec::new();
        for rule in waiting {
            let waits = rule.needs.iter().any(|need| match need {
                Need::Passed(code) | Need::NotFailed(code) | Need::NotFailedInV1(code) => {
                    !outcomes.contains_key(code) && codes.contains(code)
                }
                _ => false,
            });
            if waits {
                later.push(rule);
                continue;
            }
            let check = run_rule(context, rule, outcomes);
            outcomes.insert(rule.code, check.outcome.clone());
            checks.push(check);
        }
        if later.len() == before {
            // Rules that wait for each other: a fault of the rules, not of the URDD.
            for rule in later.drain(..) {
                let outcome = Outcome::Crashed("its needs go in a circle".to_owned());
                checks.push(Check::new(rule, outcome, Vec::new()));
            }
        }
        waiting = later;
    }
    checks
}

fn run_rule(context: &Context, rule: &'static Rule, outcomes: &Outcomes) -> Check {
    let unmet = rule
        .needs
        .iter()
        .find_map(|need| unmet(context, *need, outcomes));
    if let Some(reason) = unmet {
        return Check::new(rule, Outcome::Skipped(reason), Vec::new());
    }
    judge(context, rule, &mut Findings::default())
}

/// Lets a rule look, with findings to report to.
pub(super) fn judge(context: &Context, rule: &'static Rule, findings: &mut Findings) -> Check {
    let ran = catch_unwind(AssertUnwindSafe(|| (rule.check)(context, findings)));
    if let Err(panic) = ran {
        let message = panic_message(&*panic);
        return Check::new(rule, Outcome::Crashed(message), Vec::new());
    }
    let skipped = findings.skipped().cloned();
    let mut found = findings.take();
    let outcome = match (found.is_empty(), skipped) {
        (false, _) => Outcome::Failed,
        (true, Some(reason)) => Outcome::Skipped(reason),
        (true, None) => Outcome::Passed,
    };
    locate(context, &mut found);
    Check::new(rule, outcome, found)
}

/// What a panic said.
pub(super) fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "unknown".to_owned())
}

/// Why a need is not met, if it is not.
fn unmet(context: &Context, need: Need, outcomes: &Outcomes) -> Option<SkipReason> {
    match need {
        // What the module should say, the carried URDF says.
        Need::Module(ModuleKind::Urdf) | Need::SourceRobot if context.is_by_urdf() => None,
        Need::SourceRobot => unmet(context, Need::Module(ModuleKind::Urdf), outcomes),
        Need::Module(kind) => match context.module(kind) {
            None => Some(SkipReason::Absent(kind)),
            Some(module) => module.unusable().map(SkipReason::Unusable),
        },
        Need::AnyModule(kinds) => {
            let usable = |kind: &ModuleKind| context.document(*kind).is_some();
            (!kinds.iter().any(usable)).then_some(SkipReason::NoneUsable(kinds))
        }
        Need::RootMetadata => match context.metadata() {
            Some(_) => None,
            None => Some(SkipReason::NoRootMetadata),
        },
        Need::CarriedUrdf => context.urdf().err().cloned().map(SkipReason::NoCarriedUrdf),
        Need::Passed(code) => match outcomes.get(&code) {
            Some(Outcome::Passed) => None,
            Some(Outcome::Failed) => Some(SkipReason::Failed(code)),
            Some(Outcome::Skipped(reason)) => Some(reason.clone()),
            Some(Outcome::Crashed(_)) => Some(SkipReason::Crashed(code)),
            None => Some(SkipReason::DidNotRun(code)),
        },
        Need::NotFailedInV1(_) if context.profile() != Profile::V1 => None,
        Need::NotFailed(code) | Need::NotFailedInV1(code) => match outcomes.get(&code) {
            Some(Outcome::Failed) => Some(SkipReason::Failed(code)),
            Some(Outcome::Crashed(_)) => Some(SkipReason::Crashed(code)),
            Some(Outcome::Passed | Outcome::Skipped(_)) | None => None,
        },
        Need::Version1 => (context.profile() != Profile::V1).then_some(SkipReason::NotVersion1),
        Need::Legacy => (context.profile() != Profile::Legacy).then_some(SkipReason::NotLegacy),
    }
}
