//! Runs the rules on a URDD, or on a URDF alone, phase by phase. A rule runs only if its needs are met; a rule that crashes is caught.

use std::collections::HashMap;

use super::context::Subject;
use super::locate::locate;
use super::rule::{CheckOf, Need, Rule};
use super::skip;
use urdd_document::module::Module;
use urdd_findings::check::{Check, Outcome};
use urdd_findings::code::Code;
use urdd_findings::finding::Findings;
use urdd_findings::part::Part;
use urdd_findings::part::{Faulted, Scope};
use urdd_findings::skip::SkipReason;
use urdd_format::registry::{ModuleKind, Profile};

/// The outcome of a rule, and the parts with findings.
#[derive(Debug, Clone)]
pub(super) struct Ran {
    pub outcome: Outcome,
    pub faulted: Faulted,
}

pub(super) type Outcomes = HashMap<Code, Ran>;

/// Runs rules for one description of the robot. `outcomes` has the outcomes of rules that ran before; those of these
/// rules are added.
pub(super) fn run_all(
    subject: Subject<'_>,
    mut rules: Vec<&'static Rule>,
    outcomes: &mut Outcomes,
) -> Vec<Check> {
    rules.sort_by_key(|rule| (rule.phase, rule.code));
    let mut checks = Vec::with_capacity(rules.len());
    // A rule may need one of the same phase with a higher code: it waits for the next round.
    let mut waiting = rules;
    while !waiting.is_empty() {
        let codes: Vec<Code> = waiting.iter().map(|rule| rule.code).collect();
        let before = waiting.len();
        let mut later = Vec::new();
        for rule in waiting {
            // The caller checks as well, and discards partial results.
            if subject.urdd.is_some_and(|urdd| urdd.cancellation.is_cancelled()) {
                return checks;
            }
            let is_open = |code: &Code| !outcomes.contains_key(code) && codes.contains(code);
            if rule.needs.iter().any(|need| need.codes().iter().any(is_open)) {
                later.push(rule);
                continue;
            }
            let check = run_rule(subject, rule, outcomes);
            let ran = Ran { outcome: check.outcome.clone(), faulted: check.faulted.clone() };
            outcomes.insert(rule.code, ran);
            checks.push(check);
        }
        if later.len() == before {
            // Rules that wait for each other are a fault of the rules, not of the URDD.
            for rule in later.drain(..) {
                let outcome = Outcome::Crashed("its needs go in a circle".to_owned());
                checks.push(Check::new(&rule.description, outcome, Vec::new()));
            }
        }
        waiting = later;
    }
    checks
}

fn run_rule(subject: Subject<'_>, rule: &'static Rule, outcomes: &Outcomes) -> Check {
    if let Some(reason) = unmet(subject, Need::All(rule.needs), outcomes) {
        return Check::skipped(&rule.description, reason);
    }
    let mut unsound = HashMap::new();
    unsound_parts(subject, Need::All(rule.needs), outcomes, &mut unsound);
    judge(subject, rule, Findings::default().within(Scope::without(unsound)))
}

/// Adds the parts that a need leaves out, each with the rule that it failed.
fn unsound_parts(
    subject: Subject<'_>,
    need: Need,
    outcomes: &Outcomes,
    unsound: &mut HashMap<Part, Code>,
) {
    match need {
        Need::All(needs) => {
            for need in needs {
                unsound_parts(subject, *need, outcomes, unsound);
            }
        }
        Need::EachInV1(_) if subject.profile() != Profile::V1 => {}
        Need::Each(codes) | Need::EachInV1(codes) => {
            for code in codes {
                let faulted = outcomes.get(code).map(|ran| ran.faulted.parts());
                for part in faulted.into_iter().flatten() {
                    unsound.entry(*part).or_insert(*code);
                }
            }
        }
        _ => {}
    }
}

/// Runs a rule's check with these findings.
pub(super) fn judge(subject: Subject<'_>, rule: &'static Rule, findings: Findings) -> Check {
    judge_into(subject, rule, &mut { findings })
}

/// The same, but leaves `findings` to the caller, without the findings that are returned.
pub(super) fn judge_into(
    subject: Subject<'_>,
    rule: &'static Rule,
    findings: &mut Findings,
) -> Check {
    let judge = |findings: &mut Findings| match rule.check {
        CheckOf::Urdd(check) => check(subject.urdd?, findings),
        CheckOf::Robot(check) => check(&subject.described, findings),
    };
    let mut check = Check::caught(&rule.description, findings, judge);
    locate(subject, &mut check.findings);
    check
}

/// Why a need is not met; `None` if it is.
fn unmet(subject: Subject<'_>, need: Need, outcomes: &Outcomes) -> Option<SkipReason> {
    match need {
        // The URDF takes the module's place.
        Need::Module(ModuleKind::Urdf) | Need::SourceRobot
            if subject.described.module.is_none() && subject.described.mechanism.is_some() =>
        {
            None
        }
        // A URDF alone describes no robot where URD011 found a fault.
        Need::Module(ModuleKind::Urdf) | Need::SourceRobot if subject.urdd.is_none() => {
            unmet(subject, Need::Passed(Code::URD011), outcomes)
        }
        Need::SourceRobot => unmet(subject, Need::Module(ModuleKind::Urdf), outcomes),
        Need::Module(kind) => match subject.module(kind) {
            None => Some(SkipReason::absent(kind)),
            Some(module) => module.unusable().map(SkipReason::obstacle),
        },
        Need::ModuleV1(kind) => unmet(subject, Need::Module(kind), outcomes).or_else(|| {
            subject
                .module(kind)
                .is_some_and(Module::is_legacy)
                .then_some(skip::not_in_this_version(kind))
        }),
        Need::AnyModule(kinds) => {
            let usable = |kind: &ModuleKind| subject.module(*kind)?.document.as_ref();
            kinds.iter().find_map(usable).is_none().then(|| skip::none_usable(kinds))
        }
        Need::RootMetadata => match subject.urdd.and_then(|urdd| urdd.metadata()) {
            Some(_) => None,
            None => Some(skip::NO_ROOT_METADATA),
        },
        Need::UrdfFile if matches!(subject.described.urdf, Err(why) if why.is_too_large()) => None,
        Need::CarriedUrdf | Need::UrdfFile => {
            subject.described.urdf.err().map(|why| SkipReason::LeftOut(why.to_string().into()))
        }
        Need::All(needs) => needs.iter().find_map(|need| unmet(subject, *need, outcomes)),
        Need::NotFailedInV1(_) | Need::NoPieceInV1(_) | Need::EachInV1(_)
            if subject.profile() != Profile::V1 =>
        {
            None
        }
        Need::Each(codes) | Need::EachInV1(codes) => {
            codes.iter().find_map(|code| obstacle(outcomes, *code, Faulted::elsewhere))
        }
        Need::NoPieceInV1(code) => obstacle(outcomes, code, Faulted::has_pieces),
        Need::Passed(code) => match outcomes.get(&code).map(|ran| &ran.outcome) {
            Some(Outcome::Passed) => None,
            Some(Outcome::Failed) => Some(SkipReason::Failed(code)),
            Some(Outcome::Skipped(reason)) => Some(reason.clone()),
            Some(Outcome::Crashed(_)) => Some(SkipReason::Crashed(code)),
            None => Some(SkipReason::DidNotRun(code)),
        },
        Need::NotFailed(code) | Need::NotFailedInV1(code) => obstacle(outcomes, code, |_| true),
        Need::NoneFailed(codes) => {
            codes.iter().find_map(|code| obstacle(outcomes, *code, |_| true))
        }
        Need::Version1 => (subject.profile() != Profile::V1).then_some(skip::NOT_VERSION_1),
        Need::Legacy => (subject.profile() != Profile::Legacy).then_some(skip::NOT_LEGACY),
    }
}

/// Why another rule prevents this one: it crashed, or failed with faults that `matter`.
fn obstacle(
    outcomes: &Outcomes,
    code: Code,
    matter: impl Fn(&Faulted) -> bool,
) -> Option<SkipReason> {
    let ran = outcomes.get(&code)?;
    match ran.outcome {
        Outcome::Failed if matter(&ran.faulted) => Some(SkipReason::Failed(code)),
        Outcome::Crashed(_) => Some(SkipReason::Crashed(code)),
        _ => None,
    }
}
