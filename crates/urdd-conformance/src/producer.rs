//! Runs an external producer on the suite's robots, and scores its URDDs.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Duration;

use rayon::prelude::*;

use crate::data::{Data, ROBOTS};
use crate::examined::{codes, examine};
use crate::process::{End, Ran, Template};
use crate::refused::{self, REFUSED, Refused};
use crate::run_error::{RunError, with_threads};
use crate::skips::{Skip, SkipError};
use crate::suite::Suite;
use crate::valid;
use crate::workplace::Workplace;
use urdd_directory::cancellation::Cancellation;
use urdd_format::conformance::{
    ClassScore, ModuleScore, ModuleStatus, ProducerResult, RefusedScore, RobotModule, RobotScore,
    ScoreStatus,
};
use urdd_format::index::Count;
use urdd_format::registry::{ModuleKind, SPEC_VERSION};
use urdd_format::report::{Finding, Severity, Tool, Urdd, Verdict};
use urdd_format::root_metadata::ConformanceClass;

/// Settings of a producer run.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The command, with `{urdf}` and `{out}`.
    pub command: Template,
    /// The conformance class to require.
    pub class: ConformanceClass,
    /// The robots, those to refuse too; empty for all of the suite.
    pub robots: Vec<String>,
    /// Time limit per robot.
    pub limit: Duration,
    /// Known failures: a robot, or a module of a robot.
    pub skips: Vec<Skip>,
    /// Number of robots to run in parallel.
    pub jobs: usize,
    /// A new folder that keeps each robot's files and URDD in a subfolder; `None` for temporary folders.
    pub keep: Option<PathBuf>,
    /// Cancels the run, with all running commands and their child processes.
    pub cancellation: Cancellation,
}

/// Progress of a producer run.
#[derive(Debug)]
pub enum Event<'a> {
    /// Start, with the number of robots.
    Start(usize),
    /// A robot is scored. Called from any thread.
    Scored(&'a RobotScore),
    /// A robot to refuse is scored. Called from any thread.
    Refused(&'a RefusedScore),
}

/// Form of a line in a producer's skip list.
pub const SKIP_FORM: &str = "`robot  # reason`, or `robot module  # reason`";

/// Runs a producer on robots, and calls `observe` after each.
///
/// # Errors
/// If a robot or a module does not exist, the working folder cannot be created, or the run is cancelled.
pub fn run(
    plan: &Plan,
    suite: &Suite,
    observe: &(dyn Fn(&Event) + Sync),
) -> Result<ProducerResult, RunError> {
    let data = &suite.data;
    let to_refuse = refused::all(suite)?;
    check_skips(data, &plan.skips, &to_refuse)?;
    let (names, to_refuse) = chosen(data, &plan.robots, to_refuse)?;
    let folder = Workplace::new(plan.keep.as_deref())?;
    observe(&Event::Start(names.len() + to_refuse.len()));
    let one = |name: &String| {
        let done = robot(plan, data, name, &folder.path().join(name))?;
        observe(&Event::Scored(&done.0));
        Ok(done)
    };
    let refuse = |urdf: &Refused| {
        let folder = folder.path().join(REFUSED).join(&urdf.id);
        let done = refused(plan, urdf, &folder)?;
        observe(&Event::Refused(&done.0));
        Ok(done)
    };
    type Done<Score> = Vec<(Score, BTreeSet<usize>)>;
    let all = || -> Result<(Done<RobotScore>, Done<RefusedScore>), RunError> {
        let robots: Result<_, RunError> = names.par_iter().map(one).collect();
        let refused: Result<_, RunError> = to_refuse.par_iter().map(refuse).collect();
        Ok((robots?, refused?))
    };
    let (robots, refused) = with_threads(plan.jobs, all)?;
    let (robots, used): (Vec<RobotScore>, Vec<BTreeSet<usize>>) = robots.into_iter().unzip();
    let (refused, more): (Vec<RefusedScore>, Vec<BTreeSet<usize>>) = refused.into_iter().unzip();
    let used: BTreeSet<usize> = used.into_iter().chain(more).flatten().collect();
    let ran = |skip: &&Skip| {
        skip.words.first().is_some_and(|robot| {
            names.contains(robot) || to_refuse.iter().any(|urdf| urdf.id == *robot)
        })
    };
    let unused = plan.skips.iter().filter(ran);
    let unused = unused.filter(|skip| !used.contains(&skip.line));
    let stale_skips: Vec<String> = unused.map(Skip::what).collect();
    let robots_done = robots.iter().map(|robot| robot.status);
    let mut done = robots_done.chain(refused.iter().map(|urdf| urdf.status));
    let failed = done.any(|status| status == ScoreStatus::Failed);
    Ok(ProducerResult {
        tool: Tool::urdd(),
        spec_version: SPEC_VERSION.to_owned(),
        command: plan.command.words().to_vec(),
        class: plan.class,
        passed: !failed && stale_skips.is_empty(),
        classes: classes(plan.class, &robots),
        modules: modules(plan.class, &robots),
        robots,
        refused,
        stale_skips,
    })
}

/// The robots that were asked for, and the URDFs to refuse.
fn chosen(
    data: &Data,
    asked: &[String],
    mut to_refuse: Vec<Refused>,
) -> Result<(Vec<String>, Vec<Refused>), RunError> {
    let mut robots = valid::robots(data);
    if asked.is_empty() {
        return Ok((robots, to_refuse));
    }
    let is_known =
        |name: &&String| robots.contains(name) || to_refuse.iter().any(|urdf| urdf.id == **name);
    if let Some(unknown) = asked.iter().find(|name| !is_known(name)) {
        return Err(RunError::UnknownRobot(unknown.clone(), robots.join(", ")));
    }
    robots.retain(|robot| asked.contains(robot));
    to_refuse.retain(|urdf| asked.contains(&urdf.id));
    Ok((robots, to_refuse))
}

fn check_skips(data: &Data, skips: &[Skip], to_refuse: &[Refused]) -> Result<(), RunError> {
    let robots = valid::robots(data);
    let is_module = |word: &str| ModuleKind::ALL.iter().any(|kind| kind.name() == word);
    for skip in skips {
        let known = match skip.words.as_slice() {
            [robot] => robots.contains(robot) || to_refuse.iter().any(|urdf| urdf.id == *robot),
            [robot, module] => robots.contains(robot) && is_module(module),
            _ => false,
        };
        if !known {
            return Err(SkipError::Unknown(skip.line, skip.what()).into());
        }
    }
    Ok(())
}

/// Runs the command on a URDF to refuse. Also returns the lines of the skip list that took effect.
fn refused(
    plan: &Plan,
    urdf: &Refused,
    folder: &Path,
) -> Result<(RefusedScore, BTreeSet<usize>), RunError> {
    let (urdf_path, out) = urdf.write(folder)?;
    let paths: [(&str, &Path); 2] = [("urdf", &urdf_path), ("out", &out)];
    let ran = plan.command.run(&paths, plan.limit, &plan.cancellation)?;
    let mut score = urdf.score(ran, &out, plan.class, &plan.cancellation);
    plan.cancellation.check()?;
    let own = |skip: &&Skip| skip.words.first() == Some(&urdf.id);
    let mut used = BTreeSet::new();
    for skip in plan.skips.iter().filter(own) {
        if score.status != ScoreStatus::Passed {
            score.status = ScoreStatus::Skipped;
            score.skipped_since = Some(skip.reason.clone());
            used.insert(skip.line);
        }
    }
    Ok((score, used))
}

/// Whether a class requires a module.
fn is_asked_for(kind: ModuleKind, class: ConformanceClass) -> bool {
    kind.class().is_some_and(|first| first <= class)
}

/// Runs the command on a robot, in its own folder. Also returns the lines of the skip list that took effect.
fn robot(
    plan: &Plan,
    data: &Data,
    name: &str,
    folder: &Path,
) -> Result<(RobotScore, BTreeSet<usize>), RunError> {
    let robots = folder.join(ROBOTS);
    valid::write_robots(data, &robots)?;
    let urdf = robots.join(format!("{name}.urdf"));
    let out = folder.join(name);
    let paths: [(&str, &Path); 2] = [("urdf", &urdf), ("out", &out)];
    let ran = plan.command.run(&paths, plan.limit, &plan.cancellation)?;
    let examined = match ran.end {
        End::Status(0) => examine(&out, plan.class, &plan.cancellation),
        _ => Err(None),
    };
    plan.cancellation.check()?;
    let mut score = score(plan, name, &ran, examined);
    let used = apply_skips(plan, &mut score);
    if score.status == ScoreStatus::Passed {
        (score.stdout, score.stderr) = (None, None);
    }
    Ok((score, used))
}

fn score(plan: &Plan, name: &str, ran: &Ran, examined: Result<Urdd, Option<String>>) -> RobotScore {
    let (urdd, unreadable) = match examined {
        Ok(urdd) => (Some(urdd), None),
        Err(reason) => (None, reason),
    };
    let findings = urdd.iter().flat_map(|urdd| &urdd.findings);
    let errors: Vec<&Finding> =
        findings.filter(|finding| finding.severity == Severity::Error).collect();
    let present: BTreeSet<&str> =
        urdd.iter().flat_map(|urdd| &urdd.modules).map(|module| module.name.as_str()).collect();
    let mut modules = Vec::new();
    for kind in ModuleKind::ALL {
        let asked = is_asked_for(*kind, plan.class);
        let there = present.contains(kind.name());
        if !asked && !there {
            continue;
        }
        let of_it = |finding: &&&Finding| finding.module.as_deref() == Some(kind.name());
        let own: Vec<&Finding> = errors.iter().filter(of_it).copied().collect();
        modules.push(RobotModule {
            name: kind.name().to_owned(),
            status: match (there, own.is_empty()) {
                (false, _) => ModuleStatus::Missing,
                (true, true) => ModuleStatus::Passed,
                (true, false) => ModuleStatus::Failed,
            },
            skipped_since: None,
            codes: codes(own.iter().copied()),
            first: own.first().map(|finding| told(finding)),
        });
    }
    let known = |module: &str| ModuleKind::ALL.iter().any(|kind| kind.name() == module);
    let of_none =
        errors.iter().copied().filter(|finding| !finding.module.as_deref().is_some_and(known));
    let passed = urdd.as_ref().is_some_and(|urdd| urdd.verdict == Verdict::Pass);
    RobotScore {
        robot: name.to_owned(),
        status: match passed {
            true => ScoreStatus::Passed,
            false => ScoreStatus::Failed,
        },
        skipped_since: None,
        end: ran.end.to_string(),
        stdout: Some(ran.stdout.clone()),
        stderr: Some(ran.stderr.clone()),
        unreadable,
        codes: codes(of_none),
        modules,
    }
}

/// An error on one line, with its location.
fn told(finding: &Finding) -> String {
    let Finding { code, message, .. } = finding;
    let file = finding.file.as_deref().unwrap_or_default();
    let pointer = finding.pointer.as_deref().unwrap_or_default();
    format!("{code} {file} {pointer}: {message}")
}

/// Applies skips. A skip of the robot covers all its faults. Skips of its modules cover the robot if nothing else is
/// wrong. Returns the lines that took effect.
fn apply_skips(plan: &Plan, score: &mut RobotScore) -> BTreeSet<usize> {
    let mut used = BTreeSet::new();
    let own = |skip: &&Skip| skip.words.first() == Some(&score.robot);
    for skip in plan.skips.iter().filter(own) {
        match skip.words.get(1) {
            None if score.status == ScoreStatus::Failed => {
                score.status = ScoreStatus::Skipped;
                score.skipped_since = Some(skip.reason.clone());
                used.insert(skip.line);
            }
            None => {}
            Some(name) => {
                let mut modules = score.modules.iter_mut();
                let module = modules.find(|module| module.name == *name);
                if let Some(module) = module.filter(|m| m.status != ModuleStatus::Passed) {
                    module.skipped_since = Some(skip.reason.clone());
                    used.insert(skip.line);
                }
            }
        }
    }
    let covered = |module: &RobotModule| {
        module.status == ModuleStatus::Passed || module.skipped_since.is_some()
    };
    let any = score.modules.iter().any(|module| module.skipped_since.is_some());
    // A missing module is also an error of the directory.
    let directory = score.codes.iter().all(|code| code == MODULE_MISSING);
    if score.status == ScoreStatus::Failed
        && any
        && score.unreadable.is_none()
        && directory
        && score.modules.iter().all(covered)
    {
        score.status = ScoreStatus::Skipped;
        score.skipped_since = Some("its modules are".to_owned());
    }
    used
}

/// The rule that reports a missing module of the class.
const MODULE_MISSING: &str = "DIR019";

fn classes(asked: ConformanceClass, robots: &[RobotScore]) -> Vec<ClassScore> {
    let below = ConformanceClass::ALL.iter().copied();
    below
        .take_while(|class| *class <= asked)
        .map(|class| {
            let all = ModuleKind::ALL.iter().copied();
            let needed = all.filter(|kind| is_asked_for(*kind, class));
            let needed: Vec<&str> = needed.map(ModuleKind::name).collect();
            let passes = |robot: &&RobotScore| {
                let fine = |name: &&str| {
                    let mut modules = robot.modules.iter();
                    modules.any(|m| m.name == **name && m.status == ModuleStatus::Passed)
                };
                let directory = robot.codes.iter().all(|code| code == MODULE_MISSING);
                directory && needed.iter().all(fine)
            };
            ClassScore {
                class,
                passed: Count::saturating(robots.iter().filter(passes).count()),
                of: Count::saturating(robots.len()),
            }
        })
        .collect()
}

fn modules(asked: ConformanceClass, robots: &[RobotScore]) -> Vec<ModuleScore> {
    let mut scores = Vec::new();
    for kind in ModuleKind::ALL {
        let all = robots.iter().flat_map(|robot| &robot.modules);
        let own: Vec<&RobotModule> = all.filter(|module| module.name == kind.name()).collect();
        let of = |status: ModuleStatus| own.iter().filter(|m| m.status == status).count();
        let (passed, failed) = (of(ModuleStatus::Passed), of(ModuleStatus::Failed));
        if passed + failed == 0 && !is_asked_for(*kind, asked) {
            continue;
        }
        let codes: BTreeSet<&String> = own.iter().flat_map(|module| &module.codes).collect();
        scores.push(ModuleScore {
            name: kind.name().to_owned(),
            present: Count::saturating(passed + failed),
            passed: Count::saturating(passed),
            failed: Count::saturating(failed),
            of: Count::saturating(robots.len()),
            codes: codes.into_iter().cloned().collect(),
        });
    }
    scores
}
