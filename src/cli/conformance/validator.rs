//! `urdd conformance validator`.

use std::fmt::Write;

use clap::{Args, ValueEnum};
use semver::Version;

use super::common::RunArguments;
use crate::cli::output::{Failure, Signals};
use crate::suite;
use urdd_conformance::process::Template;
use urdd_conformance::profile::Profile;
use urdd_conformance::validator::{
    Event, Fault, Judged, Plan, SKIP_FORM, UNREADABLE_STATUS, run as run_validator,
};
use urdd_format::conformance::{
    CaseFault, CaseScore, PrintedCodes, UnreadableFault, UnreadableScore, ValidatorResult,
};
use urdd_format::index::Count;
use urdd_format::readable::first_of;
use urdd_format::registry::SPEC_VERSION;

/// Arguments of `urdd conformance validator`.
#[derive(Args)]
#[command(
    after_help = "In COMMAND, {dir} stands for the folder of a URDD; the command runs once for each case. Exit status 0 \
    accepts, 1 (or --reject-status) rejects, 2 (or --unreadable-status) says that nothing can be read as a URDD, \
    --unverified-status that something is not verified that need not be. \
    Anything else, including a signal or the time limit, is not a verdict and counts as wrong. Reject what breaks a \
    MUST of the specification, and nothing else: a URDD with warnings is to be accepted. Codes of rules that the \
    command prints, such as DOF003, are scored apart and decide nothing.\n\nExit status: 0 every verdict is right or \
    skipped; 1 a verdict is wrong, or a skip is stale; 2 usage error; 129, 130 or 143 stopped by a signal: SIGHUP, SIGINT, SIGTERM."
)]
pub struct ValidatorArguments {
    /// Version of the specification that the validator implements; cases of other versions are not run.
    #[arg(long, value_name = "VERSION", default_value = SPEC_VERSION)]
    spec_version: Version,

    /// Runs only cases whose name begins with this: `DOF`, `DOF003`, `valid/`. May be repeated.
    #[arg(long = "case", value_name = "START")]
    only: Vec<String>,

    /// Leaves out legacy URDDs, which are older than the specification.
    #[arg(long)]
    no_legacy: bool,

    /// Exit status with which the command rejects. Choose one that a crash does not have: an uncaught Python exception
    /// also ends with 1.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(i32).range(1..=255))]
    reject_status: i32,

    /// Exit status with which the command says that nothing can be read as a URDD: a folder without one, or an archive that
    /// lies. 2 without this option, and rejecting these is right then too. An uncaught exception of OCaml, or a panic of Go,
    /// also ends with 2.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(i32).range(1..=255))]
    unreadable_status: Option<i32>,

    /// Exit status with which the command says that it found no fault, and did not verify a self-collision model or spheres
    /// (SPEC 8.8.9, 8.9.7). These cases are counted apart, neither right nor wrong.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(i32).range(1..=255))]
    unverified_status: Option<i32>,

    /// Leaves out what cannot be read, and near misses of it.
    #[arg(long)]
    no_unreadable: bool,

    /// Runs only cases that a validator of this profile can decide.
    #[arg(long, value_name = "PROFILE")]
    profile: Option<ProfileName>,

    /// Judges many URDDs by one process, for a validator that starts slowly: the command has no {dir}, reads a folder a line
    /// from standard input, and answers each with a line that begins with the exit status it would have had, such as `0` or
    /// `1 DOF003`. It flushes each answer. Each of --jobs has a process of its own.
    #[arg(long)]
    batch: bool,

    #[command(flatten)]
    run: RunArguments,
}

/// A profile on the command line.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum ProfileName {
    /// Core modules, by their JSON and the source alone: no YAML mirrors, extensions, meshes, archives, legacy URDDs.
    CoreJson,
    /// The class Core: SPEC 12.2.
    Core,
    /// The class Geometry: Core and meshes.
    Geometry,
    /// The class Shapes: Geometry and shapes of links, without self-collision models and spheres.
    Shapes,
}

impl From<ProfileName> for Profile {
    fn from(name: ProfileName) -> Profile {
        match name {
            ProfileName::CoreJson => Profile::CoreJson,
            ProfileName::Core => Profile::Core,
            ProfileName::Geometry => Profile::Geometry,
            ProfileName::Shapes => Profile::Shapes,
        }
    }
}

impl ValidatorArguments {
    /// The status for what is not verified; an error if it is that of another verdict.
    fn unverified_status(&self) -> Result<Option<i32>, Failure> {
        let others = [self.reject_status, self.unreadable_status.unwrap_or(UNREADABLE_STATUS)];
        match self.unverified_status {
            Some(status) if others.contains(&status) => Err(format!(
                "--unverified-status {status} is that of another verdict: give another"
            ))?,
            status => Ok(status),
        }
    }
}

/// Runs `urdd conformance validator`. Returns whether it passed.
pub fn judged(arguments: &ValidatorArguments, signals: &Signals) -> Result<bool, Failure> {
    let command = match arguments.batch {
        true => Template::batch(&arguments.run.command, "dir"),
        false => Template::new(&arguments.run.command, &["dir"]),
    };
    let plan = Plan {
        command: command?,
        is_batch: arguments.batch,
        spec_version: arguments.spec_version.clone(),
        limit: arguments.run.limit(),
        skips: arguments.run.skips(1, SKIP_FORM)?,
        only: arguments.only.clone(),
        failed: arguments.run.failed()?,
        legacy: !arguments.no_legacy,
        unreadable: !arguments.no_unreadable,
        profile: arguments.profile.map(Profile::from),
        reject_status: arguments.reject_status,
        unreadable_status: arguments.unreadable_status,
        unverified_status: arguments.unverified_status()?,
        jobs: arguments.run.jobs.map(usize::from),
        keep: arguments.run.keep.clone(),
        cancellation: signals.cancellation(),
    };
    let suite = suite::carried()?;
    let follow = arguments.run.follow()?;
    let observe = |event: &Event| match event {
        Event::Start(of) => follow.start(*of),
        Event::Judged(judged) => {
            if let Some(fault) = judged.fault {
                follow.say(&format!("{} {}: {}", judged.id, named(fault), judged.end));
            }
            follow.done(judged.fault.is_some(), Some(judged));
        }
        Event::NotRun => follow.done(false, None::<&Judged>),
    };
    let result = run_validator(&plan, &suite, &observe);
    follow.finish()?;
    let result = result?;
    arguments.run.print(&result, human)?;
    Ok(result.passed)
}

fn named(fault: Fault) -> &'static str {
    match fault {
        Fault::Case(CaseFault::Missed) | Fault::Reading(UnreadableFault::Missed) => "missed",
        Fault::Reading(UnreadableFault::Rejected) => "rejected, and cannot be read",
        Fault::Case(CaseFault::FalseAlarm) | Fault::Reading(UnreadableFault::FalseAlarm) => {
            "FALSE ALARM"
        }
        Fault::Case(CaseFault::Undecided) | Fault::Reading(UnreadableFault::Undecided) => {
            "no verdict"
        }
    }
}

fn human(result: &ValidatorResult, out: &mut String) -> std::fmt::Result {
    for case in &result.wrong {
        let said = [&case.id, &case.title, &case.end, &case.stderr];
        wrong(said, Fault::Case(case.fault), case.skipped_since.as_deref(), out)?;
    }
    for case in &result.unreadable.wrong {
        let said = [&case.id, &case.title, &case.end, &case.stderr];
        wrong(said, Fault::Reading(case.fault), case.skipped_since.as_deref(), out)?;
    }
    for case in &result.not_run {
        writeln!(out, "{case} not run: this operating system cannot store it")?;
    }
    for family in &result.families {
        writeln!(out, "{}  {}", family.name, score(&family.score))?;
    }
    writeln!(out, "valid URDDs and near misses: {}", score(&result.sound))?;
    writeln!(out, "all of version 1: {}", score(&result.totals))?;
    if result.legacy.of.get() > 0 {
        writeln!(out, "legacy: {}", score(&result.legacy))?;
    }
    if result.unreadable.of.get() > 0 {
        writeln!(out, "what cannot be read: {}", reading_score(&result.unreadable))?;
    }
    if let Some(printed) = &result.printed_codes {
        codes(printed, out)?;
    }
    if let Some(first) = result.crashed.first() {
        writeln!(
            out,
            "warning: {} rejections look like crashes, the first is {first}: an uncaught exception ends with status 1 in \
             many languages. Reject with another status, and give it with --reject-status",
            result.crashed.len()
        )?;
    }
    if let Some(first) = result.crashed_unreadable.first() {
        writeln!(
            out,
            "warning: {} verdicts that nothing can be read look like crashes, the first is {first}: an uncaught exception of \
             OCaml and a panic of Go end with status 2. End with another status, and give it with --unreadable-status",
            result.crashed_unreadable.len()
        )?;
    }
    for stale in &result.stale_skips {
        writeln!(out, "stale skip, remove it: {stale}")?;
    }
    let verdict = if result.passed { "passed" } else { "FAILED" };
    writeln!(out, "{verdict}")
}

fn wrong(
    [id, title, end, stderr]: [&String; 4],
    fault: Fault,
    skipped_since: Option<&str>,
    out: &mut String,
) -> std::fmt::Result {
    let skipped = skipped_since.map_or(String::new(), |reason| format!(" (skipped: {reason})"));
    writeln!(out, "{id} {}{skipped}: {title}; {end}", named(fault))?;
    if matches!(
        fault,
        Fault::Case(CaseFault::Undecided) | Fault::Reading(UnreadableFault::Undecided)
    ) {
        for line in stderr.lines() {
            writeln!(out, "    {line}")?;
        }
    }
    Ok(())
}

const MAX_NAMED: usize = 10;

fn codes(printed: &PrintedCodes, out: &mut String) -> std::fmt::Result {
    writeln!(out, "printed codes: {} of {} right", printed.right.get(), printed.of.get())?;
    for (cases, what) in [
        (&printed.missing, "not printed"),
        (&printed.extra, "printed for a near miss, or for what cannot be read"),
    ] {
        if !cases.is_empty() {
            writeln!(out, "  {what}: {}", first_of(cases.iter(), MAX_NAMED))?;
        }
    }
    Ok(())
}

fn score(score: &CaseScore) -> String {
    let faults = [
        (score.missed, "missed"),
        (score.false_alarms, "false alarms"),
        (score.undecided, "without a verdict"),
        (score.unverified, "not verified"),
    ];
    counted(score.right, score.of, &faults)
}

fn reading_score(score: &UnreadableScore) -> String {
    let faults = [
        (score.missed, "missed"),
        (score.rejected, "rejected: --unreadable-status tells them from faults"),
        (score.false_alarms, "false alarms"),
        (score.undecided, "without a verdict"),
    ];
    counted(score.right, score.of, &faults)
}

fn counted(right: Count, of: Count, faults: &[(Count, &str)]) -> String {
    let mut text = format!("{} of {} right", right.get(), of.get());
    for (count, what) in faults {
        if count.get() > 0 {
            let _ = write!(text, ", {} {what}", count.get());
        }
    }
    text
}
