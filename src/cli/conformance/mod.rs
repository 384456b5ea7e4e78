//! `urdd conformance`: `export` and `producer` here, `validator` in a file of its own.

mod common;
mod validator;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Subcommand};
use serde::Serialize;

use self::common::RunArguments;
use super::arguments::Class;
use super::output::{self, Failure};
use super::watch::Watch;
use crate::suite;
use urdd_conformance::export::{CATALOGUE, CATALOGUE_1_1, export};
use urdd_conformance::process::Template;
use urdd_conformance::producer::{Event, Plan, SKIP_FORM, run as run_producer};
use urdd_directory::cancellation::Cancellation;
use urdd_format::conformance::{
    ModuleStatus, ProducerResult, RefusedOutcome, RefusedScore, RobotScore, ScoreStatus,
};
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::ConformanceClass;

/// The commands of `urdd conformance`.
#[derive(Subcommand)]
pub enum ConformanceCommand {
    /// Write the suite into a folder.
    Export {
        /// Folder to write the suite into, new or empty: robots, URDDs, and suite-1.1.json with the expected results.
        #[arg(value_name = "DIR")]
        folder: PathBuf,
    },
    /// Run a producer on the suite's robots, and score the URDDs that it writes.
    Producer(ProducerArguments),
    /// Run a validator on every case, and score its verdicts.
    Validator(validator::ValidatorArguments),
}

pub fn run(command: &ConformanceCommand, watch: &Watch) -> Result<u8, Failure> {
    match command {
        ConformanceCommand::Export { folder } => exported(folder),
        ConformanceCommand::Producer(arguments) => {
            common::run(watch, |cancellation| produced(arguments, cancellation))
        }
        ConformanceCommand::Validator(arguments) => {
            common::run(watch, |cancellation| validator::judged(arguments, cancellation))
        }
    }
}

fn exported(folder: &Path) -> Result<u8, Failure> {
    let exported = export(&suite::carried()?, folder)?;
    let (valid, cases) = (exported.valid, exported.cases);
    let mut text = format!(
        "{valid} valid URDDs and {cases} cases; {CATALOGUE_1_1} lists them, {CATALOGUE} those that can be read\n"
    );
    for case in &exported.left_out {
        text += &format!("left out, since this operating system cannot store it: {case}\n");
    }
    for robot in &exported.other_bytes {
        text += &format!(
            "valid/{robot} is correct, but its bytes differ from those that the suite was checked with, due to the platform\n"
        );
    }
    output::print(&text)?;
    Ok(0)
}

/// Arguments of `urdd conformance producer`.
#[derive(Args)]
#[command(
    after_help = "In COMMAND, {urdf} stands for a URDF file and {out} for the folder to write its URDD into; the \
    command runs once for each robot. Some URDFs have no URDD as they are: the command must refuse them (end with \
    another exit status than 0, say why, and leave nothing at {out}), or repair them (write a valid URDD that carries \
    the repaired text).\n\nExit status: 0 every robot passed or is skipped; 1 a robot failed, or a skip is stale; 2 \
    usage error; 129, 130 or 143 stopped by a signal: SIGHUP, SIGINT, SIGTERM."
)]
pub struct ProducerArguments {
    /// The required conformance class.
    #[arg(long, value_name = "CLASS", default_value = "core", ignore_case = true)]
    class: Class,

    /// A module that no class asks for, and that the command writes: `loops_module`, for which robots with loops run too, or
    /// `link_shapes_spheres_module`, with `--class shapes`. May be repeated.
    #[arg(long = "module", value_name = "NAME", value_parser = on_request())]
    modules: Vec<ModuleKind>,

    /// Runs only this robot, such as `gripper`, or `URD005/link-held-by-two-joints` of those to refuse. May be repeated.
    #[arg(long = "robot", value_name = "NAME")]
    robots: Vec<String>,

    #[command(flatten)]
    run: RunArguments,
}

/// The modules that a producer can be asked for besides those of a class.
const ON_REQUEST: [ModuleKind; 2] = [ModuleKind::Loops, ModuleKind::LinkShapesSpheres];

fn on_request() -> impl TypedValueParser<Value = ModuleKind> {
    let names = PossibleValuesParser::new(ON_REQUEST.map(ModuleKind::name));
    names.map(|name| {
        let [loops, spheres] = ON_REQUEST;
        if name == loops.name() { loops } else { spheres }
    })
}

/// A score in the log, with the seconds that the command took.
#[derive(Serialize)]
struct Timed<'a, T> {
    #[serde(flatten)]
    score: &'a T,
    seconds: &'a f64,
}

/// Runs `urdd conformance producer`. Returns whether it passed.
fn produced(arguments: &ProducerArguments, cancellation: Cancellation) -> Result<bool, Failure> {
    let failed = arguments.run.failed()?;
    if failed.is_some() && !arguments.robots.is_empty() {
        Err("give --failed or --robot, not both")?;
    }
    let class: ConformanceClass = arguments.class.into();
    let spheres = arguments.modules.contains(&ModuleKind::LinkShapesSpheres);
    if spheres && class != ConformanceClass::Shapes {
        Err(
            "--module link_shapes_spheres_module needs --class shapes: spheres stand for its shapes",
        )?;
    }
    let plan = Plan {
        command: Template::new(&arguments.run.command, &["urdf", "out"])?,
        class,
        modules: arguments.modules.clone(),
        robots: failed.unwrap_or_else(|| arguments.robots.clone()),
        limit: arguments.run.limit(),
        skips: arguments.run.skips(2, SKIP_FORM)?,
        jobs: arguments.run.jobs.map_or(1, usize::from),
        keep: arguments.run.keep.clone(),
        cancellation,
    };
    let suite = suite::carried()?;
    let follow = arguments.run.follow()?;
    let observe = |event: &Event| match event {
        Event::Start(of) => follow.start(*of),
        Event::Scored(score, seconds) => {
            follow.done(score.status == ScoreStatus::Failed, Some(&Timed { score, seconds }));
        }
        Event::Refused(score, seconds) => {
            follow.done(score.status == ScoreStatus::Failed, Some(&Timed { score, seconds }));
        }
    };
    let result = run_producer(&plan, &suite, &observe);
    follow.finish()?;
    let result = result?;
    arguments.run.print(&result, human)?;
    Ok(result.passed)
}

fn human(result: &ProducerResult, out: &mut String) -> std::fmt::Result {
    for robot in &result.robots {
        one(robot, out)?;
    }
    for urdf in &result.refused {
        to_refuse(urdf, out)?;
    }
    writeln!(out)?;
    for class in &result.classes {
        let name = class.class.as_str();
        writeln!(out, "class {name}: {} of {} robots", class.passed.get(), class.of.get())?;
    }
    for module in &result.modules {
        let codes = match module.codes.is_empty() {
            true => String::new(),
            false => format!(": {}", module.codes.join(" ")),
        };
        writeln!(out, "  {} {} of {}{codes}", module.name, module.passed.get(), module.of.get())?;
    }
    if !result.refused.is_empty() {
        let refused = result.refused.iter();
        let passed = refused.filter(|urdf| urdf.status == ScoreStatus::Passed);
        let (passed, of) = (passed.count(), result.refused.len());
        writeln!(out, "URDFs to refuse: {passed} of {of} refused or repaired")?;
    }
    for stale in &result.stale_skips {
        writeln!(out, "stale skip, remove it: {stale}")?;
    }
    let verdict = if result.passed { "passed" } else { "FAILED" };
    writeln!(out, "{verdict}")
}

fn status(status: ScoreStatus, skipped_since: Option<&str>) -> String {
    match status {
        ScoreStatus::Passed => "passed".to_owned(),
        ScoreStatus::Failed => "FAILED".to_owned(),
        ScoreStatus::Skipped => format!("skipped ({})", skipped_since.unwrap_or_default()),
    }
}

/// The codes; a module without any says less than the URDF.
fn named(codes: &[String]) -> String {
    if codes.is_empty() { "incomplete".to_owned() } else { codes.join(" ") }
}

fn indented(text: Option<&str>, out: &mut String) -> std::fmt::Result {
    text.into_iter().flat_map(str::lines).try_for_each(|line| writeln!(out, "    {line}"))
}

fn to_refuse(urdf: &RefusedScore, out: &mut String) -> std::fmt::Result {
    let status = status(urdf.status, urdf.skipped_since.as_deref());
    let fault = match urdf.outcome {
        RefusedOutcome::Refused | RefusedOutcome::Repaired => return Ok(()),
        RefusedOutcome::Written => "neither refused nor repaired",
        RefusedOutcome::LeftOver => "refused, but something is at {out}",
        RefusedOutcome::Silent => "refused, but did not say why",
        RefusedOutcome::Crashed => "crashed, or did not end by itself",
    };
    writeln!(out, "{} {status}\n  {fault}: {}", urdf.robot, urdf.end)?;
    if urdf.outcome == RefusedOutcome::Crashed {
        indented(urdf.stderr.as_deref(), out)?;
    }
    if let Some(reason) = &urdf.unreadable {
        writeln!(out, "  {reason}")?;
    }
    if !urdf.codes.is_empty() {
        writeln!(out, "  the URDD: {}", urdf.codes.join(" "))?;
    }
    Ok(())
}

fn one(robot: &RobotScore, out: &mut String) -> std::fmt::Result {
    let status = status(robot.status, robot.skipped_since.as_deref());
    writeln!(out, "{} {status}", robot.robot)?;
    if robot.status == ScoreStatus::Passed {
        return Ok(());
    }
    if robot.end != "exit status 0" {
        writeln!(out, "  {}", robot.end)?;
        indented(robot.stderr.as_deref(), out)?;
    }
    if let Some(reason) = &robot.unreadable {
        writeln!(out, "  {reason}")?;
    }
    if !robot.codes.is_empty() {
        writeln!(out, "  the directory: {}", robot.codes.join(" "))?;
    }
    for module in &robot.modules {
        let skipped = match &module.skipped_since {
            Some(reason) => format!(" (skipped: {reason})"),
            None => String::new(),
        };
        match module.status {
            ModuleStatus::Passed => {}
            // If there is no output at all, the text above says so.
            ModuleStatus::Missing if robot.unreadable.is_some() => {}
            ModuleStatus::Missing if robot.end != "exit status 0" => {}
            ModuleStatus::Missing => writeln!(out, "  {} is missing{skipped}", module.name)?,
            ModuleStatus::Failed => {
                writeln!(out, "  {}{skipped}: {}", module.name, named(&module.codes))?;
                if let Some(first) = &module.first {
                    writeln!(out, "    {first}")?;
                }
            }
        }
    }
    Ok(())
}
