//! Leaves out some places of findings: those that follow from others, so that one fault gives one message, and those beyond the
//! memory of a run of many URDDs: these are counted and dropped. The result depends on the URDDs alone, not on the order of
//! their examination.

use std::collections::{HashMap, HashSet};

use super::check::{Check, FollowsFrom, Outcome};
use super::code::Code;
use super::finding::{Finding, bytes};
use super::part::SkipReason;
use urdd_directory::position::Position;
use urdd_format::report::{Place, Severity};

/// Keeps the places of a rule's findings that `keeps` says; it is given each place, with its message, and its severity.
/// `reason` says why the rest was left out.
pub fn retain(
    check: &mut Check,
    reason: SkipReason,
    mut keeps: impl FnMut(Severity, &Place) -> bool,
) {
    let before = check.findings.len();
    for finding in std::mem::take(&mut check.findings) {
        let severity = finding.severity.unwrap_or(check.severity);
        let (groups, cut) = parted(finding, |place| keeps(severity, place));
        let kept = groups.into_iter().find(|(keeps, _)| *keeps);
        check.findings.extend(kept.map(|(_, mut kept)| {
            kept.count += cut;
            kept
        }));
    }
    if before > 0 && check.findings.is_empty() {
        check.outcome = Outcome::Skipped(reason);
    }
}

/// A finding for each value that `key` has at its places, and the number of its places that are not listed.
pub fn parted<K: PartialEq>(
    mut finding: Finding,
    mut key: impl FnMut(&Place) -> K,
) -> (Vec<(K, Finding)>, usize) {
    let cut = finding.count.saturating_sub(1 + finding.more.len());
    let first = std::mem::take(&mut finding.place);
    let more = std::mem::take(&mut finding.more);
    let mut groups: Vec<(K, Finding)> = Vec::new();
    for mut place in std::iter::once(first).chain(more) {
        // The first place says it for those that follow, and may go.
        let message = place.message.get_or_insert_with(|| finding.message.clone()).clone();
        let key = key(&place);
        match groups.iter_mut().find(|(other, _)| *other == key) {
            Some((_, group)) => {
                place.message.take_if(|other| *other == group.message);
                group.more.push(place);
                group.count += 1;
            }
            None => {
                place.message = None;
                let group = Finding { place, message, count: 1, ..finding.clone() };
                groups.push((key, group));
            }
        }
    }
    (groups, cut)
}

/// Approximate memory limit for the places of a run, in bytes.
pub const KEPT_OF_RUN: usize = 256 << 20;
/// The least that each URDD may keep, in bytes.
pub const LEAST_OF_URDD: usize = 256 << 10;

/// Memory limit for the places of each URDD of a run, in bytes.
pub fn of_each(urdds: usize) -> usize {
    (KEPT_OF_RUN / urdds.max(1)).max(LEAST_OF_URDD)
}

/// Approximate memory of a finding without its texts, in bytes. A constant, so that a report is the same on every
/// machine.
const FINDING: usize = 256;

/// Drops places beyond `most` bytes. Keeps the worst places of each finding and at least one finding of each rule.
/// Counts include what is dropped.
pub fn trim(checks: &mut [Check], most: usize) {
    let mut left = most;
    for check in checks {
        let mut kept = 0;
        for finding in &mut check.findings {
            let first = finding.message.len() + FINDING;
            if left < first && kept > 0 {
                break;
            }
            kept += 1;
            left = left.saturating_sub(first);
            let fits = |other: &&Place| {
                let bytes = bytes(other);
                let fits = bytes <= left;
                left = left.saturating_sub(bytes);
                fits
            };
            let places = finding.more.iter().take_while(fits).count();
            finding.more.truncate(places);
            finding.more.shrink_to_fit();
        }
        let cut: usize = check.findings.drain(kept..).map(|f| f.count).sum();
        if let Some(last) = check.findings.last_mut() {
            last.count += cut;
        }
    }
}

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
