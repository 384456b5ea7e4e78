//! Runs an external validator on the suite, and scores its verdicts.
//!
//! The verdict is the exit status only: 0 accepts, 1 (or an agreed status) rejects. Any other is not a verdict.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::time::Duration;

use rayon::prelude::*;
use semver::Version;
use serde::Serialize;

use crate::batch::Batch;
use crate::case::{Case, Kind, Verdict};
use crate::catalogue::{Item, items};
use crate::data::{ROBOTS, VALID};
use crate::export::write_valid;
use crate::process::{End, Ran, Template};
use crate::running::{Result, RunError, Workplace, relative, with_threads};
use crate::skips::{self, Skip};
use crate::suite::Suite;
use crate::tree::{TreeError, remove_folder};
use crate::{printed_codes, valid};
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_format::conformance::{CaseFault, CaseScore, GroupScore, ValidatorResult, WrongCase};
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
    /// The exit status for rejection.
    pub reject_status: i32,
    /// Number of URDDs to judge in parallel; `None` for the number of processors.
    pub jobs: Option<usize>,
    /// A new folder that keeps the URDDs; `None` for a temporary one.
    pub keep: Option<PathBuf>,
    /// Cancels the run, with all running commands and their child processes.
    pub cancellation: Cancellation,
}

/// The result for one URDD, reported while others are still running.
#[derive(Debug, Clone, Serialize)]
pub struct Judged<'a> {
    /// The case.
    pub id: &'a str,
    /// The expected verdict.
    pub expected: Verdict,
    /// How the verdict is wrong; `None` if it is right.
    pub fault: Option<CaseFault>,
    /// How the command ended.
    pub end: String,
    /// Whether the command seems to have crashed, so that its exit status is unreliable.
    pub crashed: bool,
    /// The end of its standard error.
    pub stderr: &'a str,
    /// The codes of rules that it printed.
    pub codes: Vec<&'static str>,
}

/// A URDD to judge.
struct Chosen<'a> {
    item: Item,
    /// `None` for valid URDDs.
    case: Option<&'a Case>,
    /// Whether `{dir}` is relative to the current folder.
    is_relative: bool,
}

/// Progress of a validator run.
#[derive(Debug)]
pub enum Event<'a> {
    /// Start, with the number of URDDs.
    Start(usize),
    /// A URDD is judged. Called from any thread.
    Judged(Judged<'a>),
    /// A case that this operating system cannot represent.
    NotRun,
}

/// Form of a line in a validator's skip list.
pub const SKIP_FORM: &str = "`case  # reason`, `code  # reason`, or `family  # reason`";

/// Runs a validator on several URDDs in parallel, and calls `observe` after each.
///
/// # Errors
/// If there is nothing to run, the working folder cannot be created, or the run is cancelled.
pub fn run(
    plan: &Plan,
    suite: &Suite,
    observe: &(dyn Fn(&Event) + Sync),
) -> Result<ValidatorResult> {
    let (data, all) = (&suite.data, urdds(suite));
    skips::check(&plan.skips, |skip| all.iter().any(|urdd| covers(skip, &urdd.item)))?;
    let begins = |item: &Item| plan.only.iter().any(|start| item.id.starts_with(start));
    let chosen = all.into_iter().filter(|Chosen { item, .. }| {
        item.spec_versions.matches(&plan.spec_version)
            && (plan.only.is_empty() || begins(item))
            && (plan.legacy || !is_legacy(item))
    });
    let chosen: Vec<Chosen> = chosen.collect();
    if chosen.is_empty() {
        return Err(RunError::NoCase);
    }
    let folder = Workplace::new(plan.keep.as_deref())?;
    observe(&Event::Start(chosen.len()));
    let is_chosen = |robot: &String| {
        let mut folders = chosen.iter().map(|urdd| &urdd.item.folder);
        folders.any(|folder| *folder == valid::id(robot))
    };
    let names: Vec<String> = valid::robots(data).into_iter().filter(is_chosen).collect();
    if !names.is_empty() {
        let robots = folder.path().join(ROBOTS);
        valid::write_robots(data, &robots)?;
        let valid = folder.path().join(VALID);
        write_valid(data, &names, &robots, &valid, &plan.cancellation).map_err(|error| {
            if plan.cancellation.is_cancelled() { RunError::Cancelled(Cancelled) } else { error }
        })?;
    }
    let batch = plan.is_batch.then(|| Batch::new(plan.command.words()));
    let judge = |urdd: &Chosen| -> Result<Option<Ran>> {
        let ran = judge(plan, batch.as_ref(), suite, urdd, &folder)?;
        match &ran {
            Some(ran) => observe(&Event::Judged(Judged {
                id: &urdd.item.id,
                expected: urdd.item.verdict,
                fault: fault(plan, urdd.item.verdict, &ran.end),
                end: ran.end.to_string(),
                crashed: looks_crashed(plan, ran),
                stderr: &ran.stderr,
                codes: ran.codes.iter().copied().map(Code::as_str).collect(),
            })),
            None => observe(&Event::NotRun),
        }
        Ok(ran)
    };
    let all = || -> Result<Vec<Option<Ran>>> { chosen.par_iter().map(judge).collect() };
    let ran = match plan.jobs {
        None => all(),
        Some(jobs) => with_threads(jobs, all),
    };
    let items: Vec<Item> = chosen.into_iter().map(|urdd| urdd.item).collect();
    Ok(scored(plan, &items, ran?))
}

/// Every URDD of the suite, and two of them again with a relative `{dir}`: one to accept, one to reject.
fn urdds(suite: &Suite) -> Vec<Chosen<'_>> {
    let case_of = |item: &Item| suite.cases.iter().find(|case| case.id() == item.id);
    let urdd = |item: Item| Chosen { case: case_of(&item), item, is_relative: false };
    let mut urdds: Vec<Chosen> = items(suite).into_iter().map(urdd).collect();
    for (verdict, id, title) in [
        (Verdict::Accept, "relative/valid", "a valid URDD"),
        (Verdict::Reject, "relative/invalid", "a URDD with a fault"),
    ] {
        let fits = |urdd: &&Chosen| urdd.item.verdict == verdict && !is_legacy(&urdd.item);
        let Some(Chosen { item, case, .. }) = urdds.iter().find(fits) else { continue };
        let folder = match case {
            Some(case) => format!("{id}/{}", case.urdd()),
            None => item.folder.clone(),
        };
        let again = Item {
            id: id.to_owned(),
            title: format!("{title}, of which {{dir}} is a relative path"),
            folder,
            code: None,
            ..item.clone()
        };
        urdds.push(Chosen { item: again, case: *case, is_relative: true });
    }
    urdds
}

fn is_legacy(item: &Item) -> bool {
    item.profile == Profile::Legacy.as_str()
}

/// Runs the command on one URDD; `None` if this operating system cannot represent it.
fn judge(
    plan: &Plan,
    batch: Option<&Batch>,
    suite: &Suite,
    urdd: &Chosen,
    folder: &Workplace,
) -> Result<Option<Ran>> {
    plan.cancellation.check()?;
    let path = folder.path().join(&urdd.item.folder);
    if let Some(case) = urdd.case {
        match case.write(&suite.tree(case)?, &path) {
            Ok(()) => {}
            Err(TreeError::Unsupported(_)) => return Ok(None),
            Err(error) => return Err(error.into()),
        }
    }
    let Some(shown) = (if urdd.is_relative { relative(&path) } else { Some(path.clone()) }) else {
        return Ok(None);
    };
    let ran = match batch {
        None => plan.command.run(&[("dir", &shown)], plan.limit, &plan.cancellation)?,
        Some(batch) => batch.ask(&shown, plan.limit, &plan.cancellation)?,
    };
    if let (Some(case), Some(around), None) = (urdd.case, path.parent(), &plan.keep) {
        debug_assert!(path.ends_with(case.urdd()));
        remove_folder(around)?;
    }
    Ok(Some(ran))
}

/// How the verdict on a URDD is wrong; `None` if it is right.
fn fault(plan: &Plan, expected: Verdict, end: &End) -> Option<CaseFault> {
    match (end, expected) {
        (End::Status(0), Verdict::Accept) => None,
        (End::Status(0), Verdict::Reject) => Some(CaseFault::Missed),
        (End::Status(status), _) if *status != plan.reject_status => Some(CaseFault::Undecided),
        (End::Status(_), Verdict::Reject) => None,
        (End::Status(_), Verdict::Accept) => Some(CaseFault::FalseAlarm),
        _ => Some(CaseFault::Undecided),
    }
}

/// Whether a rejection looks like a crash. It still counts as a rejection, with a warning.
fn looks_crashed(plan: &Plan, ran: &Ran) -> bool {
    ran.end == End::Status(plan.reject_status) && ran.looks_crashed()
}

fn covers(skip: &Skip, item: &Item) -> bool {
    let code = item.code.as_deref().unwrap_or_default();
    let what = skip.what();
    what == item.id || what == code || (!code.is_empty() && what == family(code))
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

fn scored(plan: &Plan, items: &[Item], ran: Vec<Option<Ran>>) -> ValidatorResult {
    let (mut totals, mut sound, mut legacy) = (Faults::new(), Faults::new(), Faults::new());
    let mut crashed = Vec::new();
    let mut families: BTreeMap<&str, Faults> = BTreeMap::new();
    let mut codes: BTreeMap<&str, Faults> = BTreeMap::new();
    let (mut wrong, mut not_run) = (Vec::new(), Vec::new());
    let (mut relevant, mut used) = (BTreeSet::new(), BTreeSet::new());
    let printed = items.iter().zip(&ran).filter(|(item, _)| !is_legacy(item));
    let printed = printed.filter_map(|(item, ran)| Some((item, &ran.as_ref()?.codes)));
    let printed_codes = printed_codes::score(printed);
    for (item, ran) in items.iter().zip(ran) {
        let Some(ran) = ran else {
            not_run.push(item.id.clone());
            continue;
        };
        let fault = fault(plan, item.verdict, &ran.end);
        if is_legacy(item) {
            legacy.push(fault)
        } else {
            totals.push(fault)
        }
        if item.kind != Kind::Invalid && !is_legacy(item) {
            sound.push(fault);
        }
        if looks_crashed(plan, &ran) {
            crashed.push(item.id.clone());
        }
        if let Some(code) = item.code.as_deref() {
            families.entry(family(code)).or_default().push(fault);
            codes.entry(code).or_default().push(fault);
        }
        let mut reason = None;
        for skip in plan.skips.iter().filter(|skip| covers(skip, item)) {
            relevant.insert(skip.line);
            if fault.is_some() {
                used.insert(skip.line);
                reason.get_or_insert_with(|| skip.reason.clone());
            }
        }
        if let Some(fault) = fault {
            wrong.push(WrongCase {
                id: item.id.clone(),
                title: item.title.clone(),
                fault,
                end: ran.end.to_string(),
                stderr: ran.stderr,
                skipped_since: reason,
            });
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
    let excused = wrong.iter().all(|case| case.skipped_since.is_some());
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
    }
}
