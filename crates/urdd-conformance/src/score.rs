//! Scores how a validator judged: by code, by family, and in sums; and the codes of rules that it printed.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::time::Duration;

use semver::Version;
use serde::Serialize;

use crate::data::UNREADABLE;
use crate::export::Item;
use crate::process::{End, Ran, Template};
use crate::running::Skip;
use crate::suite::{CaseKind, Verdict};
use urdd_directory::cancellation::Cancellation;
use urdd_format::conformance::{
    CaseFault, CaseScore, GroupScore, PrintedCodes, UnreadableCase, UnreadableFault,
    UnreadableScore, ValidatorProfile, ValidatorResult, WrongCase,
};
use urdd_format::index::Count;
use urdd_format::registry::Profile;
use urdd_format::report::Tool;
use urdd_validate::code::Code;

/// Settings of a validator run.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The command, with `{dir}` unless it is a batch.
    pub command: Template,
    /// Whether a process of the command judges many URDDs.
    pub is_batch: bool,
    /// The version of the specification that the validator implements.
    pub spec_version: Version,
    /// Time limit per URDD.
    pub limit: Duration,
    /// Known failures: a case, or all cases of a code or a family.
    pub skips: Vec<Skip>,
    /// Id prefixes of the cases to run; empty for all.
    pub only: Vec<String>,
    /// Whether to include legacy URDDs.
    pub legacy: bool,
    /// Whether to include cases about what cannot be read.
    pub unreadable: bool,
    /// The profile of the validator: only cases that it can decide are run; `None` for a whole one.
    pub profile: Option<ValidatorProfile>,
    /// The exit status for rejection.
    pub reject_status: i32,
    /// The exit status for what cannot be read; `None` for 2, where rejecting it is good enough too.
    pub unreadable_status: Option<i32>,
    /// Number of URDDs to judge in parallel; `None` for the number of processors.
    pub jobs: Option<usize>,
    /// A new folder that keeps the URDDs; `None` for a temporary one.
    pub keep: Option<PathBuf>,
    /// Cancels the run, with all running commands and their child processes.
    pub cancellation: Cancellation,
}

/// The exit status for what cannot be read, where none is asked for.
const UNREADABLE_STATUS: i32 = 2;

/// How a verdict is wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub enum Fault {
    /// On a URDD that can be read.
    Case(CaseFault),
    /// On a case about what cannot be read.
    Reading(UnreadableFault),
}

/// How the verdict on a URDD is wrong; `None` if it is right, or a rejection is good enough.
pub(crate) fn fault(plan: &Plan, item: &Item, end: &End) -> Option<Fault> {
    match item.is_about_reading {
        true => reading_fault(plan, item.verdict, end)
            // SPEC 2.14 asks no validator for a status of its own: whoever gives none may reject.
            .filter(|fault| *fault != UnreadableFault::Rejected || plan.unreadable_status.is_some())
            .map(Fault::Reading),
        false => case_fault(plan, item.verdict, end).map(Fault::Case),
    }
}

fn case_fault(plan: &Plan, expected: Verdict, end: &End) -> Option<CaseFault> {
    match (end, expected) {
        (End::Status(0), Verdict::Accept) => None,
        (End::Status(0), _) => Some(CaseFault::Missed),
        (End::Status(status), _) if *status != plan.reject_status => Some(CaseFault::Undecided),
        (End::Status(_), Verdict::Accept) => Some(CaseFault::FalseAlarm),
        (End::Status(_), _) => None,
        _ => Some(CaseFault::Undecided),
    }
}

fn reading_fault(plan: &Plan, expected: Verdict, end: &End) -> Option<UnreadableFault> {
    let End::Status(status) = *end else { return Some(UnreadableFault::Undecided) };
    let is_unreadable = status == plan.unreadable_status.unwrap_or(UNREADABLE_STATUS);
    match (status, expected) {
        (0, Verdict::Accept) => None,
        (0, _) => Some(UnreadableFault::Missed),
        (_, Verdict::Accept) if is_unreadable || status == plan.reject_status => {
            Some(UnreadableFault::FalseAlarm)
        }
        (_, Verdict::Unreadable) if is_unreadable => None,
        (_, Verdict::Unreadable) if status == plan.reject_status => Some(UnreadableFault::Rejected),
        _ => Some(UnreadableFault::Undecided),
    }
}

/// Whether a rejection looks like a crash. It still counts as a rejection, with a warning.
pub(crate) fn looks_crashed(plan: &Plan, ran: &Ran) -> bool {
    ran.end == End::Status(plan.reject_status) && ran.looks_crashed()
}

pub(crate) fn covers(skip: &Skip, item: &Item) -> bool {
    let code = item.code.as_deref().unwrap_or_default();
    let what = skip.what();
    what == item.id
        || what == code
        || (!code.is_empty() && what == family(code))
        || (item.is_about_reading && what == UNREADABLE)
}

fn family(code: &str) -> &str {
    code.get(..3).unwrap_or(code)
}

/// How cases were judged; `None` for right.
type Faults = Vec<Option<CaseFault>>;

fn counted(faults: &[Option<CaseFault>]) -> CaseScore {
    let count = |fault| Count::saturating(faults.iter().filter(|one| **one == fault).count());
    CaseScore {
        of: Count::saturating(faults.len()),
        right: count(None),
        missed: count(Some(CaseFault::Missed)),
        false_alarms: count(Some(CaseFault::FalseAlarm)),
        undecided: count(Some(CaseFault::Undecided)),
    }
}

fn counted_reading(faults: &[Option<UnreadableFault>]) -> UnreadableScore {
    let count = |fault| Count::saturating(faults.iter().filter(|one| **one == fault).count());
    UnreadableScore {
        of: Count::saturating(faults.len()),
        right: count(None),
        missed: count(Some(UnreadableFault::Missed)),
        rejected: count(Some(UnreadableFault::Rejected)),
        false_alarms: count(Some(UnreadableFault::FalseAlarm)),
        undecided: count(Some(UnreadableFault::Undecided)),
        wrong: Vec::new(),
    }
}

pub(crate) fn is_legacy(item: &Item) -> bool {
    item.profile == Profile::Legacy.as_str()
}

/// The result of a run: `ran` is of `items`, and `None` for those that this operating system cannot represent.
pub(crate) fn scored(plan: &Plan, items: &[Item], ran: Vec<Option<Ran>>) -> ValidatorResult {
    let reading = items.iter().zip(&ran).filter(|(item, _)| item.is_about_reading);
    let reading: Vec<Option<UnreadableFault>> = reading
        .filter_map(|(item, ran)| Some(reading_fault(plan, item.verdict, &ran.as_ref()?.end)))
        .collect();
    let mut unreadable = counted_reading(&reading);
    let (mut totals, mut sound, mut legacy) = (Faults::new(), Faults::new(), Faults::new());
    let mut crashed = Vec::new();
    let mut families: BTreeMap<&str, Faults> = BTreeMap::new();
    let mut codes: BTreeMap<&str, Faults> = BTreeMap::new();
    let (mut wrong, mut not_run) = (Vec::new(), Vec::new());
    let (mut relevant, mut used) = (BTreeSet::new(), BTreeSet::new());
    let printed = items.iter().zip(&ran).filter(|(item, _)| !is_legacy(item));
    let printed = printed.filter_map(|(item, ran)| Some((item, &ran.as_ref()?.codes)));
    let printed_codes = score_codes(printed);
    for (item, ran) in items.iter().zip(ran) {
        let Some(ran) = ran else {
            not_run.push(item.id.clone());
            continue;
        };
        let fault = fault(plan, item, &ran.end);
        if !item.is_about_reading {
            let fault = case_fault(plan, item.verdict, &ran.end);
            let (is_legacy, is_sound) = (is_legacy(item), item.kind != CaseKind::Invalid);
            if is_legacy { &mut legacy } else { &mut totals }.push(fault);
            if is_sound && !is_legacy {
                sound.push(fault);
            }
            if let Some(code) = item.code.as_deref() {
                families.entry(family(code)).or_default().push(fault);
                codes.entry(code).or_default().push(fault);
            }
        }
        if looks_crashed(plan, &ran) {
            crashed.push(item.id.clone());
        }
        let mut reason = None;
        for skip in plan.skips.iter().filter(|skip| covers(skip, item)) {
            relevant.insert(skip.line);
            if fault.is_some() {
                used.insert(skip.line);
                reason.get_or_insert_with(|| skip.reason.clone());
            }
        }
        let (id, title, end) = (item.id.clone(), item.title.clone(), ran.end.to_string());
        let (stderr, skipped_since) = (ran.stderr, reason);
        match fault {
            None => {}
            Some(Fault::Case(fault)) => {
                wrong.push(WrongCase { id, title, fault, end, stderr, skipped_since });
            }
            Some(Fault::Reading(fault)) => {
                let case = UnreadableCase { id, title, fault, end, stderr, skipped_since };
                unreadable.wrong.push(case);
            }
        }
    }
    // Skips of cases that were not run are not stale.
    let stale = |skip: &&Skip| relevant.contains(&skip.line) && !used.contains(&skip.line);
    let stale_skips: Vec<String> = plan.skips.iter().filter(stale).map(Skip::what).collect();
    let groups = |judged: BTreeMap<&str, Faults>| {
        let group = |(name, faults): (&str, Faults)| GroupScore {
            name: name.to_owned(),
            score: counted(&faults),
        };
        judged.into_iter().map(group).collect()
    };
    let excused = wrong.iter().all(|case| case.skipped_since.is_some())
        && unreadable.wrong.iter().all(|case| case.skipped_since.is_some());
    ValidatorResult {
        tool: Tool::urdd(),
        spec_version: plan.spec_version.to_string(),
        command: plan.command.words().to_vec(),
        passed: excused && stale_skips.is_empty(),
        totals: counted(&totals),
        sound: counted(&sound),
        legacy: counted(&legacy),
        families: groups(families),
        codes: groups(codes),
        printed_codes,
        wrong,
        crashed,
        not_run,
        stale_skips,
        profile: plan.profile,
        unreadable,
    }
}

/// Scores the codes that a command printed for cases; `None` if it printed none at all. What cannot be read has no code:
/// any that is printed for it is one too many.
fn score_codes<'a>(
    ran: impl Iterator<Item = (&'a Item, &'a BTreeSet<Code>)> + Clone,
) -> Option<PrintedCodes> {
    if ran.clone().all(|(_, codes)| codes.is_empty()) {
        return None;
    }
    let (mut of, mut missing, mut extra) = (0, Vec::new(), Vec::new());
    for (item, codes) in ran {
        if item.verdict == Verdict::Unreadable {
            if !codes.is_empty() {
                extra.push(item.id.clone());
            }
            of += 1;
            continue;
        }
        let Some(code) = item.code.as_deref() else { continue };
        let is_printed = codes.iter().any(|printed| printed.as_str() == code);
        match (item.kind, item.verdict) {
            (CaseKind::Valid, _) | (CaseKind::Invalid, Verdict::Accept) => continue,
            (CaseKind::Invalid, Verdict::Reject) if !is_printed => missing.push(item.id.clone()),
            (CaseKind::NearMiss, _) if is_printed => extra.push(item.id.clone()),
            _ => {}
        }
        of += 1;
    }
    Some(PrintedCodes {
        of: Count::saturating(of),
        right: Count::saturating(of - missing.len() - extra.len()),
        missing,
        extra,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn item(kind: CaseKind, verdict: Verdict, code: Option<&str>) -> Item {
        Item {
            id: format!("{kind:?} {verdict:?}"),
            folder: String::new(),
            kind,
            code: code.map(str::to_owned),
            title: String::new(),
            profile: "1.0",
            spec_versions: semver::VersionReq::STAR,
            verdict,
            findings: Vec::new(),
            is_about_reading: code.is_none(),
            profiles: Vec::new(),
        }
    }

    #[test]
    fn what_cannot_be_read_has_no_code() {
        let unreadable = item(CaseKind::Invalid, Verdict::Unreadable, None);
        let near_miss = item(CaseKind::NearMiss, Verdict::Accept, None);
        let rejected = item(CaseKind::Invalid, Verdict::Reject, Some("DOF003"));
        let none = BTreeSet::new();
        let one = BTreeSet::from([Code::DOF003]);
        let score = |printed: &BTreeSet<Code>| {
            let ran = [(&unreadable, printed), (&near_miss, printed), (&rejected, &one)];
            let score = score_codes(ran.into_iter()).expect("a code was printed");
            (score.of, score.right, score.missing, score.extra)
        };
        let [one_case, two_cases] = [1, 2].map(Count::saturating);
        assert_eq!(score(&none), (two_cases, two_cases, vec![], vec![]));
        assert_eq!(score(&one), (two_cases, one_case, vec![], vec![unreadable.id.clone()]));
    }
}
