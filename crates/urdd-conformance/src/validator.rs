//! Runs an external validator on the suite, and scores its verdicts.
//!
//! The verdict is the exit status only: 0 accepts, 1 (or an agreed status) rejects, 2 (or an agreed status) says that
//! nothing can be read as a URDD, and an agreed status that something is not verified. Any other is not a verdict.

use rayon::prelude::*;
use serde::Serialize;

use crate::batch::Batch;
use crate::data::{ROBOTS, VALID, valid_id};
use crate::export::{Item, items, write_valid};
use crate::process::Ran;
use crate::running::{Result, RunError, Workplace, check_skips, relative, with_threads};
pub use crate::score::{Fault, Plan, UNREADABLE_STATUS};
use crate::score::{covers, fault, is_legacy, is_unverified, looks_crashed, scored};
use crate::suite::{Case, Suite, Verdict};
use crate::tree::{TreeError, remove_folder};
use urdd_directory::cancellation::Cancelled;
use urdd_format::conformance::ValidatorResult;
use urdd_validate::code::Code;

/// The result for one URDD, reported while others are still running.
#[derive(Debug, Clone, Serialize)]
pub struct Judged<'a> {
    /// The case.
    pub id: &'a str,
    /// The expected verdict.
    pub expected: Verdict,
    /// How the verdict is wrong; `None` if it is right.
    pub fault: Option<Fault>,
    /// Whether it is not verified, as the specification allows: neither right nor wrong.
    pub unverified: bool,
    /// How the command ended.
    pub end: String,
    /// How long it took.
    pub seconds: f64,
    /// Whether the command seems to have crashed, so that its exit status is unreliable.
    pub crashed: bool,
    /// The end of its standard error.
    pub stderr: &'a str,
    /// The codes of rules that it printed.
    pub codes: Vec<&'static str>,
}

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
    let (data, all) = (&suite.data, urdds(suite)?);
    check_skips(&plan.skips, |skip| all.iter().any(|urdd| covers(skip, &urdd.item)))?;
    let begins = |item: &Item| plan.only.iter().any(|start| item.id.starts_with(start));
    let again = |failed: &Vec<String>, item: &Item| failed.contains(&item.id);
    let chosen = all.into_iter().filter(|Chosen { item, .. }| {
        item.spec_versions.matches(&plan.spec_version)
            && (plan.only.is_empty() || begins(item))
            && plan.failed.as_ref().is_none_or(|failed| again(failed, item))
            && (plan.legacy || !is_legacy(item))
            && (plan.unreadable || !item.is_about_reading)
            && plan.profile.is_none_or(|profile| item.profiles.contains(&profile))
    });
    let chosen: Vec<Chosen> = chosen.collect();
    if chosen.is_empty() {
        return Err(RunError::NoCase);
    }
    let folder = Workplace::new(plan.keep.as_deref())?;
    observe(&Event::Start(chosen.len()));
    let is_chosen = |robot: &String| {
        let mut folders = chosen.iter().map(|urdd| &urdd.item.folder);
        folders.any(|folder| *folder == valid_id(robot))
    };
    let names: Vec<String> = data.robots().into_iter().filter(is_chosen).collect();
    if !names.is_empty() {
        let robots = folder.path().join(ROBOTS);
        data.write_robots(&robots)?;
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
                fault: fault(plan, &urdd.item, &ran.end),
                unverified: is_unverified(plan, &urdd.item, &ran.end),
                end: ran.end.to_string(),
                seconds: ran.seconds(),
                crashed: looks_crashed(plan, &urdd.item, ran),
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
fn urdds(suite: &Suite) -> Result<Vec<Chosen<'_>>> {
    let case_of = |item: &Item| suite.all_cases().find(|case| case.id() == item.id);
    let urdd = |item: Item| Chosen { case: case_of(&item), item, is_relative: false };
    let mut urdds: Vec<Chosen> = items(suite)?.into_iter().map(urdd).collect();
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
    Ok(urdds)
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
