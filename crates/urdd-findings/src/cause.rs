//! Findings that follow from others: reports leave them out where they have the cause, so that one fault gives one message.

use std::collections::{HashMap, HashSet};

use super::check::{Check, FollowsFrom, Outcome};
use super::code::Code;
use super::places::{parted, retain};
use super::skip::SkipReason;
use urdd_directory::position::Position;
use urdd_format::report::{Place, Severity};

/// Where a place is.
pub fn at(place: &Place) -> Option<Position> {
    Some(Position { line: place.line?.0, column: place.column?.0 })
}

/// What findings lead to: its severities and places, by rule and place.
type Effects = HashMap<(Code, Position), Vec<(Severity, Place)>>;

/// Leaves out what follows from a reported cause. Causes name their effects, and are as severe as the worst of them. A rule
/// with effects alone was prevented by the rule of the cause.
pub(super) fn fold(checks: &mut [Check]) {
    if checks.iter().all(|check| check.effects.is_empty()) {
        return;
    }
    let place = |check: &Check, (place, _): (&Place, &str)| Some((check.rule.code, at(place)?));
    let reported: HashSet<(Code, Position)> = checks
        .iter()
        .flat_map(|check| check.said().filter_map(move |said| place(check, said)))
        .collect();
    let mut effects = Effects::new();
    let mut prevented: HashMap<Code, Code> = HashMap::new();
    for check in &mut *checks {
        let mut left = std::mem::take(&mut check.effects);
        left.retain(|one| reported.contains(&one.cause));
        let Some(by) = left.first().map(|one| one.cause.0) else {
            continue;
        };
        let rule = check.rule;
        let mut by_place: HashMap<Position, Vec<FollowsFrom>> = HashMap::new();
        for one in left {
            by_place.entry(one.at).or_default().push(one);
        }
        retain(check, SkipReason::Failed(by), |severity, place| {
            let here = at(place).and_then(|at| by_place.get_mut(&at));
            let this = here.and_then(|here| {
                let said = place.message.as_ref();
                let which = here.iter().position(|one| said == Some(&one.message))?;
                Some(here.swap_remove(which))
            });
            let Some(one) = this else { return true };
            let effect = Place {
                message: Some(format!("{} {}: {}", rule.code, rule.name, one.message)),
                related: Vec::new(),
                fixes: Vec::new(),
                ..place.clone()
            };
            effects.entry(one.cause).or_default().push((severity, effect));
            false
        });
        if check.findings.is_empty() {
            prevented.insert(rule.code, by);
        }
    }
    for check in checks {
        if let Outcome::Skipped(SkipReason::Failed(code)) = &mut check.outcome {
            *code = *prevented.get(code).unwrap_or(code);
        }
        name_effects(check, &effects);
    }
}

/// Adds what findings lead to.
fn name_effects(check: &mut Check, effects: &Effects) {
    let code = check.rule.code;
    if !effects.keys().any(|(cause, _)| *cause == code) {
        return;
    }
    let of = |place: &Place| effects.get(&(code, at(place)?));
    for finding in std::mem::take(&mut check.findings) {
        let own = finding.severity.unwrap_or(check.severity);
        let (groups, mut cut) = parted(finding, |place| {
            let severities = of(place)?.iter().map(|(severity, _)| *severity);
            severities.max().filter(|worst| *worst > own)
        });
        for (worst, mut group) in groups {
            group.count += std::mem::take(&mut cut);
            group.severity = worst.or(group.severity);
            for place in group.places_mut() {
                let effects = of(place).into_iter().flatten().map(|(_, effect)| effect.clone());
                place.related.extend(effects);
            }
            check.findings.push(group);
        }
    }
}
