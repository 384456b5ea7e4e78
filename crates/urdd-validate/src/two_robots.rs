//! By which description of the robot rules judge, where a URDD has two: `urdf_module`, and the
//! URDF that it carries.
//!
//! That the two agree is for URD001 and URD013 to say. Where they do not, one fault should still be
//! one message, and a second fault should not hide behind the first:
//!
//! - What a robot is like (SRC) is judged by its source: the carried URDF where it can be read.
//! - A module that follows from the robot is judged by each of the two, and is at fault where it
//!   is so by both. One that was made from the URDF as it was before somebody changed it follows
//!   from `urdf_module`; one beside an `urdf_module` that was damaged follows from the URDF. In
//!   neither case is there anything to add to what URD001 says. What follows from neither is wrong
//!   by itself.
//!
//! Each of the two runs keeps its own account of what rules found, so that a rule may count on what
//! it needs; then they are put together rule by rule.

use std::collections::{HashMap, HashSet};

use super::code::Code;
use super::context::Context;
use super::engine::{Check, Outcome, Outcomes, judge, judge_into, run_all};
use super::finding::Findings;
use super::rule::{Judges, Rule};
use super::skip::SkipReason;

/// Runs rules over a URDD; the checks are in order of code.
pub(super) fn run(context: &Context, rules: &[&'static Rule]) -> Vec<Check> {
    let mut checks = run_by_both(context, rules);
    checks.sort_by_key(|check| check.rule.code);
    checks
}

fn run_by_both(context: &Context, rules: &[&'static Rule]) -> Vec<Check> {
    let mut outcomes = Outcomes::new();
    let Some(by_urdf) = context.by_urdf() else {
        return run_all(context, rules.to_vec(), &mut outcomes);
    };
    let of = |kind: Judges| {
        rules
            .iter()
            .copied()
            .filter(move |rule| rule.judges == kind)
    };
    let once = of(Judges::AsItStands)
        .chain(of(Judges::Robot))
        .chain(of(Judges::Derived));
    let once = once.collect();
    let mut checks = run_all(context, once, &mut outcomes);
    let differs = difference(&outcomes);

    let mut second: Vec<&'static Rule> = of(Judges::Source).collect();
    // Whether the URDF's robot is sound enough for the others; urdf_module's was judged above.
    let sound: Vec<&'static Rule> = of(Judges::Robot).collect();
    second.extend(&sound);
    if differs.is_some() {
        second.extend(of(Judges::Derived));
    }
    for rule in &second {
        outcomes.remove(&rule.code);
    }
    let mut again: HashMap<Code, Check> = run_all(&by_urdf, second, &mut outcomes)
        .into_iter()
        .map(|check| (check.rule.code, check))
        .collect();
    for rule in &sound {
        again.remove(&rule.code);
    }
    if let Some(differs) = differs {
        for check in &mut checks {
            if let Some(second) = again.remove(&check.rule.code) {
                put_together(check, second, context, &by_urdf);
            }
        }
        tell_why_skipped(&mut checks, differs);
    }
    checks.extend(again.into_values());
    checks
}

/// Which rule did not find that `urdf_module` is what the URDF says.
fn difference(outcomes: &Outcomes) -> Option<Code> {
    [Code::URD001, Code::URD013].into_iter().find(|code| {
        outcomes
            .get(code)
            .is_some_and(|ran| ran.outcome != Outcome::Passed)
    })
}

/// Makes one check of two: by `urdf_module`, and by the URDF.
fn put_together(check: &mut Check, second: Check, context: &Context, by_urdf: &Context) {
    let both = match (&check.outcome, &second.outcome) {
        (Outcome::Crashed(_), _) | (_, Outcome::Skipped(_)) => return,
        (Outcome::Skipped(_), _) | (_, Outcome::Crashed(_)) => second,
        (Outcome::Failed, Outcome::Failed) => at_fault_by_both(check, &second, context, by_urdf),
        (Outcome::Passed, _) | (_, Outcome::Passed) => {
            Check::new(check.rule, Outcome::Passed, Vec::new())
        }
    };
    *check = both;
}

/// What a rule that failed twice finds in the same places. It looks once more, since of many
/// findings only the first few are kept.
fn at_fault_by_both(first: &Check, second: &Check, context: &Context, by_urdf: &Context) -> Check {
    let mut spots = Findings::remembering_spots().within(first.scope.afresh());
    judge_into(context, first.rule, &mut spots);
    let both = Findings::only_at(spots.into_spots()).within(second.scope.afresh());
    judge(by_urdf, first.rule, both)
}

/// A rule that was skipped because another failed, and that other one has nothing left to say now:
/// the reason is that the two robots differ.
fn tell_why_skipped(checks: &mut [Check], differs: Code) {
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
