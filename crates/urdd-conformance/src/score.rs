//! Scores how a validator judged: by code, by family, and in sums; and the codes of rules that it printed.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::time::Duration;

use semver::Version;
use serde::Serialize;

use crate::data::UNREADABLE;
use crate::export::Item;
use crate::process::{End, Ran, Template};
use crate::profile::Profile;
use crate::running::Skip;
use crate::suite::{CaseKind, Verdict};
use urdd_directory::cancellation::Cancellation;
use urdd_format::conformance::{
    CaseFault, CaseScore, GroupScore, PrintedCodes, UnreadableCase, UnreadableFault,
    UnreadableScore, ValidatorProfile, ValidatorResult, WrongCase,
};
use urdd_format::index::Count;
use urdd_format::registry::Profile as Edition;
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
    /// Ids of cases that failed in an earlier run, to run these alone; `None` for all.
    pub failed: Option<Vec<String>>,
    /// Whether to include legacy URDDs.
    pub legacy: bool,
    /// Whether to include cases about what cannot be read.
    pub unreadable: bool,
    /// The profile of the validator: only cases that it can decide are run; `None` for a whole one.
    pub profile: Option<Profile>,
    /// The exit status for rejection.
    pub reject_status: i32,
    /// The exit status for what cannot be read; `None` for 2, where rejecting it is good enough too.
    pub unreadable_status: Option<i32>,
    /// The exit status for what is not verified (SPEC 8.8.9, 8.9.7); `None` where it is not a verdict.
    pub unverified_status: Option<i32>,
    /// Number of URDDs to judge in parallel; `None` for the number of processors.
    pub jobs: Option<usize>,
    /// A new folder that keeps the URDDs; `None` for a temporary one.
    pub keep: Option<PathBuf>,
    /// Cancels the run, with all running commands and their child processes.
    pub cancellation: Cancellation,
}

/// The exit status for what cannot be read, where none is asked for.
pub const UNREADABLE_STATUS: i32 = 2;

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
        false => case_fault(plan, item, end).map(Fault::Case),
    }
}

/// Whether a command said that it did not verify what the specification lets it leave so.
pub(crate) fn is_unverified(plan: &Plan, item: &Item, end: &End) -> bool {
    item.may_be_unverified && says_unverified(plan, end)
}

fn says_unverified(plan: &Plan, end: &End) -> bool {
    plan.unverified_status.is_some_and(|status| *end == End::Status(status))
}

fn case_fault(plan: &Plan, item: &Item, end: &End) -> Option<CaseFault> {
    match (end, item.verdict) {
        _ if is_unverified(plan, item, end) => None,
        (End::Status(0), Verdict::Accept) => None,
        (End::Status(0), _) => Some(CaseFault::Missed),
        // Of a URDD with a fault that has to be verified.
        (_, Verdict::Reject) if says_unverified(plan, end) => Some(CaseFault::Missed),
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

/// Whether a rejection, or a verdict that nothing can be read, looks like a crash. It still counts as that verdict, with a
/// warning.
pub(crate) fn looks_crashed(plan: &Plan, item: &Item, ran: &Ran) -> bool {
    let End::Status(status) = ran.end else { return false };
    let is_unreadable = status == plan.unreadable_status.unwrap_or(UNREADABLE_STATUS);
    let is_verdict = status == plan.reject_status || (item.is_about_reading && is_unreadable);
    is_verdict && ran.looks_crashed()
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

/// How a case was judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Judgement {
    Right,
    Wrong(CaseFault),
    Unverified,
}

fn judgement(plan: &Plan, item: &Item, end: &End) -> Judgement {
    match case_fault(plan, item, end) {
        Some(fault) => Judgement::Wrong(fault),
        None if is_unverified(plan, item, end) => Judgement::Unverified,
        None => Judgement::Right,
    }
}

fn counted(judged: &[Judgement]) -> CaseScore {
    let count = |one| Count::saturating(judged.iter().filter(|other| **other == one).count());
    CaseScore {
        of: Count::saturating(judged.len()),
        right: count(Judgement::Right),
        missed: count(Judgement::Wrong(CaseFault::Missed)),
        false_alarms: count(Judgement::Wrong(CaseFault::FalseAlarm)),
        undecided: count(Judgement::Wrong(CaseFault::Undecided)),
        unverified: count(Judgement::Unverified),
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
    item.profile == Edition::Legacy.as_str()
}

/// The result of a run: `ran` is of `items`, and `None` for those that this operating system cannot represent.
pub(crate) fn scored(plan: &Plan, items: &[Item], ran: Vec<Option<Ran>>) -> ValidatorResult {
    let reading = items.iter().zip(&ran).filter(|(item, _)| item.is_about_reading);
    let reading: Vec<Option<UnreadableFault>> = reading
        .filter_map(|(item, ran)| Some(reading_fault(plan, item.verdict, &ran.as_ref()?.end)))
        .collect();
    let mut unreadable = counted_reading(&reading);
    let (mut totals, mut sound, mut legacy) = (Vec::new(), Vec::new(), Vec::new());
    let (mut crashed, mut crashed_unreadable, mut unverified) = (vec![], vec![], vec![]);
    let mut families: BTreeMap<&str, Vec<Judgement>> = BTreeMap::new();
    let mut codes: BTreeMap<&str, Vec<Judgement>> = BTreeMap::new();
    let (mut wrong, mut not_run) = (Vec::new(), Vec::new());
    let (mut relevant, mut used) = (BTreeSet::new(), BTreeSet::new());
    let printed = items.iter().zip(&ran).filter(|(item, _)| !is_legacy(item));
    let printed = printed.filter_map(|(item, ran)| Some((item, ran.as_ref()?)));
    let printed = printed.filter(|(item, ran)| !is_unverified(plan, item, &ran.end));
    let printed = printed.map(|(item, ran)| (item, &ran.codes));
    let printed_codes = score_codes(printed);
    for (item, ran) in items.iter().zip(ran) {
        let Some(ran) = ran else {
            not_run.push(item.id.clone());
            continue;
        };
        let fault = fault(plan, item, &ran.end);
        if !item.is_about_reading {
            let judged = judgement(plan, item, &ran.end);
            let (is_legacy, is_sound) = (is_legacy(item), item.kind != CaseKind::Invalid);
            if is_legacy { &mut legacy } else { &mut totals }.push(judged);
            if is_sound && !is_legacy {
                sound.push(judged);
            }
            if let Some(code) = item.code.as_deref() {
                families.entry(family(code)).or_default().push(judged);
                codes.entry(code).or_default().push(judged);
            }
            if judged == Judgement::Unverified {
                // A skip of it is neither used nor stale.
                unverified.push(item.id.clone());
                continue;
            }
        }
        if looks_crashed(plan, item, &ran) {
            let is_rejection = ran.end == End::Status(plan.reject_status);
            if is_rejection { &mut crashed } else { &mut crashed_unreadable }.push(item.id.clone());
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
    let groups = |judged: BTreeMap<&str, Vec<Judgement>>| {
        let group = |(name, judged): (&str, Vec<Judgement>)| GroupScore {
            name: name.to_owned(),
            score: counted(&judged),
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
        profile: plan
            .profile
            .filter(|one| *one == Profile::CoreJson)
            .map(|_| ValidatorProfile::CoreJson),
        unreadable,
        unverified,
        crashed_unreadable,
        class: plan.profile.and_then(Profile::class),
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
            may_be_unverified: false,
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
