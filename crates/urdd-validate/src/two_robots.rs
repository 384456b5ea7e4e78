//! Chooses the description of the robot that rules use, if a URDD has two: `urdf_module` and its carried URDF.
//!
//! URD001 and URD013 report where the two differ. Even then, one fault should give one finding, and a second fault
//! should not be hidden by the first:
//!
//! - Rules about the robot itself (SRC) use its source: the carried URDF, if it is readable.
//! - A module derived from the robot is judged against both, and is faulty only if both give a fault. A module made
//!   from the URDF before it was changed follows from `urdf_module`; one beside a damaged `urdf_module` follows from
//!   the URDF. In both cases URD001 reports the difference. A module that follows from neither is itself wrong.
//!
//! Each of the two runs keeps its own outcomes, so that a rule's needs hold for its own run. The results are then
//! combined rule by rule.

use std::collections::{HashMap, HashSet};

use super::context::Context;
use super::engine::{Outcomes, judge, judge_into, run_all};
use super::rule::{Need, Rule};
use urdd_findings::check::{Check, Outcome};
use urdd_findings::code::Code;
use urdd_findings::description::Phase;
use urdd_findings::finding::Findings;
use urdd_findings::skip::SkipReason;

/// What a rule judges, and so which of the two descriptions it uses.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Judges {
    /// Files, texts, a module on its own, or a module against the URDF. Runs once.
    AsItStands,
    /// Whether the robot is valid: a tree of links, mimics that can be resolved. Runs for both descriptions, because
    /// other rules depend on it.
    Robot,
    /// The robot itself, whatever the modules contain. Uses the source if it is readable.
    Source,
    /// Data derived from the robot. A fault counts only if both descriptions give it.
    Derived,
}

impl Judges {
    /// What a rule judges, by what it needs.
    pub(super) fn of(rule: &Rule) -> Judges {
        let needs = |wanted: Need| rule.needs.contains(&wanted);
        match (rule.phase, rule.code.family()) {
            (Phase::Files | Phase::Syntax | Phase::Schema, _) => Judges::AsItStands,
            _ if needs(Need::CarriedUrdf) || needs(Need::UrdfFile) => Judges::AsItStands,
            _ if needs(Need::SourceRobot) => Judges::Source,
            (_, "URD") => Judges::Robot,
            // The meshes that urdf_module names, and the columns of a module that say the same.
            (_, "SRC") => Judges::AsItStands,
            _ if rule.code == Code::BND002 => Judges::AsItStands,
            _ => Judges::Derived,
        }
    }
}

/// Runs rules on a URDD. The checks are ordered by code.
pub(super) fn run(context: &Context, rules: &[&'static Rule]) -> Vec<Check> {
    let mut checks = run_by_both(context, rules);
    checks.sort_by_key(|check| check.rule.code);
    checks
}

fn run_by_both(context: &Context, rules: &[&'static Rule]) -> Vec<Check> {
    let mut outcomes = Outcomes::new();
    let Some(by_urdf) = context.by_urdf() else {
        return run_all(context.into(), rules.to_vec(), &mut outcomes);
    };
    let of = |kind: Judges| rules.iter().copied().filter(move |rule| Judges::of(rule) == kind);
    let once = of(Judges::AsItStands).chain(of(Judges::Robot)).chain(of(Judges::Derived)).collect();
    let mut checks = run_all(context.into(), once, &mut outcomes);
    let differs = difference(&outcomes);

    let mut second: Vec<&'static Rule> = of(Judges::Source).collect();
    // Whether the URDF's robot is valid enough for the other rules; that of urdf_module was judged above.
    let sound: Vec<&'static Rule> = of(Judges::Robot).collect();
    second.extend(&sound);
    if differs.is_some() {
        second.extend(of(Judges::Derived));
    }
    for rule in &second {
        outcomes.remove(&rule.code);
    }
    let mut again: HashMap<Code, Check> = run_all((&by_urdf).into(), second, &mut outcomes)
        .into_iter()
        .map(|check| (check.rule.code, check))
        .collect();
    for rule in &sound {
        again.remove(&rule.code);
    }
    if let Some(differs) = differs {
        for check in &mut checks {
            let rule = rules.iter().find(|rule| rule.code == check.rule.code);
            let second = again.remove(&check.rule.code);
            if let Some((rule, second)) = rule.zip(second) {
                put_together(rule, check, second, [context, &by_urdf]);
            }
        }
        update_reasons(&mut checks, differs);
    }
    checks.extend(again.into_values());
    checks
}

/// The rule that did not confirm that `urdf_module` matches the URDF.
fn difference(outcomes: &Outcomes) -> Option<Code> {
    [Code::URD001, Code::URD013]
        .into_iter()
        .find(|code| outcomes.get(code).is_some_and(|ran| ran.outcome != Outcome::Passed))
}

/// Combines the check by `urdf_module` with the check by the URDF.
fn put_together(rule: &'static Rule, check: &mut Check, second: Check, contexts: [&Context; 2]) {
    *check = match (&check.outcome, &second.outcome) {
        (Outcome::Crashed(_), _) | (_, Outcome::Skipped(_)) => return,
        (Outcome::Skipped(_), _) | (_, Outcome::Crashed(_)) => second,
        (Outcome::Failed, Outcome::Failed) => at_fault_by_both(rule, [&*check, &second], contexts),
        (Outcome::Passed, _) | (_, Outcome::Passed) => {
            Check::new(check.rule, Outcome::Passed, Vec::new())
        }
    };
}

/// The findings of a rule at the places where it failed both times. Runs it once more, because only the first of many
/// findings are kept.
fn at_fault_by_both(
    rule: &'static Rule,
    [first, second]: [&Check; 2],
    [context, by_urdf]: [&Context; 2],
) -> Check {
    let mut spots = Findings::remembering_spots().within(first.scope.afresh());
    judge_into(context.into(), rule, &mut spots);
    let both = Findings::only_at(spots.into_spots()).within(second.scope.afresh());
    judge(by_urdf.into(), rule, both)
}

/// Replaces the reason of rules that were skipped because of a rule that no longer has findings: the two robots differ.
fn update_reasons(checks: &mut [Check], differs: Code) {
    let settled: HashSet<Code> = checks
        .iter()
        .filter(|check| check.outcome == Outcome::Passed)
        .map(|check| check.rule.code)
        .collect();
    for check in checks {
        if let Outcome::Skipped(SkipReason::Failed(code)) = &mut check.outcome
            && settled.contains(code)
        {
            *code = differs;
        }
    }
}
