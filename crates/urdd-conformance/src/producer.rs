//! Runs an external producer on the suite's robots, and scores its URDDs.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Duration;

use parking_lot::Mutex;
use rayon::prelude::*;

use crate::data::{Data, ROBOTS};
use crate::looped;
use crate::process::{End, Ran, Template};
use crate::refused::{self, REFUSED, Refused, codes, examine};
use crate::running::{Result, RunError, Skip, Workplace, check_skips, with_threads};
use crate::suite::Suite;
use urdd_directory::cancellation::{Cancellation, Cancelled};
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
    /// Modules to require that no class asks for. Robots with loops run where `loops_module` is one of them.
    pub modules: Vec<ModuleKind>,
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
    /// A robot is scored, after so many seconds of the command. Called from any thread.
    Scored(&'a RobotScore, f64),
    /// A robot to refuse is scored. Called from any thread.
    Refused(&'a RefusedScore, f64),
}

/// Form of a line in a producer's skip list.
pub const SKIP_FORM: &str = "`robot  # reason`, or `robot module  # reason`";

struct Sources {
    robots: Vec<String>,
    /// Those of `robots` that have loops.
    looped: Vec<String>,
    to_refuse: Vec<Refused>,
}

impl Sources {
    fn has(&self, id: &str) -> bool {
        self.robots.iter().any(|robot| robot == id)
            || self.to_refuse.iter().any(|urdf| urdf.id == id)
    }

    /// Keeps those that were asked for; nothing asked for is all, robots with loops where their module is asked for.
    fn choose(&mut self, asked: &[String], modules: &[ModuleKind]) -> Result<()> {
        if let Some(unknown) = asked.iter().find(|id| !self.has(id)) {
            return Err(RunError::UnknownRobot(unknown.clone(), self.robots.join(", ")));
        }
        let all = |robot: &String| {
            asked.is_empty()
                && (modules.contains(&ModuleKind::Loops) || !self.looped.contains(robot))
        };
        self.robots.retain(|robot| all(robot) || asked.contains(robot));
        self.to_refuse.retain(|urdf| asked.is_empty() || asked.contains(&urdf.id));
        Ok(())
    }

    fn is_known(&self, skip: &Skip) -> bool {
        let is_module = |word: &str| ModuleKind::ALL.iter().any(|kind| kind.name() == word);
        match skip.words.as_slice() {
            [id] => self.has(id),
            [robot, module] => self.robots.contains(robot) && is_module(module),
            _ => false,
        }
    }
}

/// Runs a producer on robots, and calls `observe` after each.
///
/// # Errors
/// If a robot or a module does not exist, the working folder cannot be created, or the run is cancelled.
pub fn run(
    plan: &Plan,
    suite: &Suite,
    observe: &(dyn Fn(&Event) + Sync),
) -> Result<ProducerResult> {
    let data = &suite.data;
    let looped = data.looped();
    let robots = [data.robots(), looped.clone()].concat();
    let mut sources = Sources { robots, looped, to_refuse: refused::all(suite)? };
    check_skips(&plan.skips, |skip| sources.is_known(skip))?;
    sources.choose(&plan.robots, &plan.modules)?;
    let Sources { robots: names, looped, to_refuse } = &sources;
    let folder = Workplace::new(plan.keep.as_deref())?;
    observe(&Event::Start(names.len() + to_refuse.len()));
    // The lines of the skip list that took effect.
    let used = Mutex::new(BTreeSet::new());
    let one = |name: &String| -> Result<RobotScore> {
        let (mut score, seconds) =
            robot(plan, data, name, looped.contains(name), &folder.path().join(name))?;
        used.lock().extend(apply_skips(plan, &mut score));
        if score.status == ScoreStatus::Passed {
            (score.stdout, score.stderr) = (None, None);
        }
        observe(&Event::Scored(&score, seconds));
        Ok(score)
    };
    let refuse = |urdf: &Refused| -> Result<RefusedScore> {
        let (mut score, seconds) =
            refused(plan, urdf, &folder.path().join(REFUSED).join(&urdf.id))?;
        let skips = plan.skips.iter().filter(|skip| skip.words.first() == Some(&urdf.id));
        if score.status != ScoreStatus::Passed {
            for skip in skips {
                score.status = ScoreStatus::Skipped;
                score.skipped_since = Some(skip.reason.clone());
                used.lock().insert(skip.line);
            }
        }
        observe(&Event::Refused(&score, seconds));
        Ok(score)
    };
    let all = || -> Result<(Vec<RobotScore>, Vec<RefusedScore>)> {
        let robots = names.par_iter().map(one).collect::<Result<_, _>>()?;
        Ok((robots, to_refuse.par_iter().map(refuse).collect::<Result<_, _>>()?))
    };
    let (robots, refused) = with_threads(plan.jobs, all)?;
    let used = used.into_inner();
    let ran = |skip: &&Skip| skip.words.first().is_some_and(|id| sources.has(id));
    let unused = plan.skips.iter().filter(ran).filter(|skip| !used.contains(&skip.line));
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
        modules: modules(plan, &robots),
        robots,
        refused,
        stale_skips,
    })
}

fn ran(plan: &Plan, urdf: &Path, out: &Path) -> Result<Ran, Cancelled> {
    plan.command.run(&[("urdf", urdf), ("out", out)], plan.limit, &plan.cancellation)
}

fn refused(plan: &Plan, urdf: &Refused, folder: &Path) -> Result<(RefusedScore, f64)> {
    let (path, out) = urdf.write(folder)?;
    let ran = ran(plan, &path, &out)?;
    let seconds = ran.seconds();
    let score = urdf.score(ran, &out, plan.class, &plan.cancellation);
    plan.cancellation.check()?;
    Ok((score, seconds))
}

fn is_asked_for(kind: ModuleKind, class: ConformanceClass) -> bool {
    kind.class().is_some_and(|first| first <= class)
}

/// Runs the command on a robot, in its own folder.
fn robot(
    plan: &Plan,
    data: &Data,
    name: &str,
    is_looped: bool,
    folder: &Path,
) -> Result<(RobotScore, f64)> {
    let robots = folder.join(ROBOTS);
    match is_looped {
        true => data.write_looped(&robots)?,
        false => data.write_robots(&robots)?,
    }
    let out = folder.join(name);
    let ran = ran(plan, &robots.join(format!("{name}.urdf")), &out)?;
    let examined = match ran.end {
        End::Status(0) => examine(&out, plan.class, &plan.cancellation),
        _ => Err(None),
    };
    plan.cancellation.check()?;
    let seconds = ran.seconds();
    let is_asked_for = |kind: ModuleKind| {
        let on_request = plan.modules.contains(&kind) && (kind != ModuleKind::Loops || is_looped);
        on_request || is_asked_for(kind, plan.class)
    };
    let mut score = score(name, is_asked_for, ran, examined);
    if is_looped {
        let mut modules = score.modules.iter_mut();
        let loops = modules.find(|module| module.name == ModuleKind::Loops.name());
        if let Some(module) = loops.filter(|module| module.status == ModuleStatus::Passed)
            && let Some(fault) = looped::fault(data, name, &out)?
        {
            (module.status, module.first) = (ModuleStatus::Failed, Some(fault));
        }
    }
    if score.modules.iter().any(|module| module.status != ModuleStatus::Passed) {
        score.status = ScoreStatus::Failed;
    }
    Ok((score, seconds))
}

fn score(
    name: &str,
    is_asked_for: impl Fn(ModuleKind) -> bool,
    ran: Ran,
    examined: Result<Urdd, Option<String>>,
) -> RobotScore {
    let (urdd, unreadable) = match examined {
        Ok(urdd) => (Some(urdd), None),
        Err(reason) => (None, reason),
    };
    let findings = urdd.iter().flat_map(|urdd| &urdd.findings);
    let errors: Vec<&Finding> =
        findings.filter(|finding| finding.severity == Severity::Error).collect();
    let mut modules = Vec::new();
    for kind in ModuleKind::ALL {
        let mut present = urdd.iter().flat_map(|urdd| &urdd.modules);
        let there = present.any(|module| module.name == kind.name());
        if !there && !is_asked_for(*kind) {
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
        status: if passed { ScoreStatus::Passed } else { ScoreStatus::Failed },
        skipped_since: None,
        end: ran.end.to_string(),
        stdout: Some(ran.stdout),
        stderr: Some(ran.stderr),
        unreadable,
        codes: codes(of_none),
        modules,
    }
}

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
            let passes = |robot: &&RobotScore| {
                let is_fine = |kind: &ModuleKind| {
                    let mut modules = robot.modules.iter();
                    modules.any(|m| m.name == kind.name() && m.status == ModuleStatus::Passed)
                };
                let mut needed = ModuleKind::ALL.iter().filter(|kind| is_asked_for(**kind, class));
                robot.codes.iter().all(|code| code == MODULE_MISSING) && needed.all(is_fine)
            };
            ClassScore {
                class,
                passed: Count::saturating(robots.iter().filter(passes).count()),
                of: Count::saturating(robots.len()),
            }
        })
        .collect()
}

fn modules(plan: &Plan, robots: &[RobotScore]) -> Vec<ModuleScore> {
    let mut scores = Vec::new();
    for kind in ModuleKind::ALL {
        let all = robots.iter().flat_map(|robot| &robot.modules);
        let own: Vec<&RobotModule> = all.filter(|module| module.name == kind.name()).collect();
        let of = |status: ModuleStatus| own.iter().filter(|m| m.status == status).count();
        let (passed, failed) = (of(ModuleStatus::Passed), of(ModuleStatus::Failed));
        let on_request = plan.modules.contains(kind);
        if passed + failed == 0 && !on_request && !is_asked_for(*kind, plan.class) {
            continue;
        }
        let codes: BTreeSet<&String> = own.iter().flat_map(|module| &module.codes).collect();
        scores.push(ModuleScore {
            name: kind.name().to_owned(),
            present: Count::saturating(passed + failed),
            passed: Count::saturating(passed),
            failed: Count::saturating(failed),
            // Those that have to have it.
            of: Count::saturating(if on_request { own.len() } else { robots.len() }),
            codes: codes.into_iter().cloned().collect(),
        });
    }
    scores
}
