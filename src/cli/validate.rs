//! `urdd validate`.

use std::fs;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::output;
use crate::report::human::{self, Style};
use crate::report::model::Verdict;
use crate::report::place::places;
use crate::report::{self, Report};
use crate::validate::rule::Severity;
use crate::validate::settings::{self, Settings};
use crate::validate::{self, rules};

/// Exit status: conforming.
const CONFORMING: u8 = 0;
/// Exit status: findings.
const FINDINGS: u8 = 1;
/// Exit status: wrong usage, or nothing could be examined.
const USAGE: u8 = 2;
/// Exit status: a rule crashed.
const INTERNAL: u8 = 101;

/// Arguments of `urdd validate`.
#[derive(Args)]
#[command(
    after_help = "Exit status: 0 conforming; 1 findings at or above --fail-on; 2 wrong usage, or nothing could be \
    examined; 101 a rule crashed (a fault of this program)."
)]
pub struct ValidateArguments {
    /// URDDs, or folders with URDDs at any depth.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,

    /// How the report is written to standard output.
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,

    /// Writes the report to a file too, in the format of the file's ending: .sarif, .xml (JUnit),
    /// otherwise JSON. May be given several times.
    #[arg(long, value_name = "FILE")]
    output: Vec<PathBuf>,

    /// The conformance class to hold every URDD to: core, geometry or shapes.
    #[arg(long, value_name = "CLASS")]
    class: Option<String>,

    /// Recomputes sampled data (distance statistics) in full, however long it takes.
    #[arg(long)]
    deep: bool,

    /// The severity from which on a run fails: error, warning or info.
    #[arg(long, value_name = "SEVERITY")]
    fail_on: Option<String>,

    /// Settings file; without it, urdd.toml in the current folder where there is one.
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,

    /// Leaves out URDDs without findings.
    #[arg(long, short)]
    quiet: bool,

    /// Runs a rule that crashes too, to see how crashes are reported.
    #[arg(long, hide = true)]
    with_crashing_rule: bool,
}

/// How a report is written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people.
    Human,
    /// As JSON; its schema is `urdd schema show report@1.0.0`.
    Json,
    /// As SARIF 2.1.0, for GitHub code scanning and editors. Run at the root of the repository.
    Sarif,
    /// As JUnit XML, for what shows tests: a suite for each URDD, a case for each rule.
    Junit,
}

impl Format {
    /// The format that the name of a file asks for.
    fn of_file(file: &Path) -> Format {
        let name = file.to_string_lossy().to_ascii_lowercase();
        if name.ends_with(".sarif") || name.ends_with(".sarif.json") {
            Format::Sarif
        } else if name.ends_with(".xml") {
            Format::Junit
        } else {
            Format::Json
        }
    }
}

/// Runs `urdd validate`.
pub fn run(arguments: &ValidateArguments) -> ExitCode {
    match validate(arguments) {
        Ok(status) => ExitCode::from(status),
        Err(message) => {
            output::error(&message);
            ExitCode::from(USAGE)
        }
    }
}

fn validate(arguments: &ValidateArguments) -> Result<u8, String> {
    let settings = read_settings(arguments)?;
    let fail_on = settings.fail_on.unwrap_or(Severity::Error);
    let mut rules = rules::all();
    if arguments.with_crashing_rule {
        rules.push(&rules::testing::crashing_rule::RULE);
    }
    // A crashed rule is caught and reported; the default hook would print besides.
    std::panic::set_hook(Box::new(|_| {}));
    let run = validate::validate_with(&arguments.paths, &settings, &rules)
        .map_err(|error| error.to_string());
    let _ = std::panic::take_hook();
    let run = run?;
    let report = Report::new(&run, fail_on);
    let status = status(&report);
    let current = std::env::current_dir().unwrap_or_default();
    let places = places(&run, &current);

    let style = Style {
        color: output::color(std::io::stdout().is_terminal()),
        quiet: arguments.quiet,
    };
    let render = |format: Format| -> Result<String, String> {
        match format {
            Format::Json => report::json(&report).map_err(|error| error.to_string()),
            Format::Sarif => {
                report::sarif(&run, &report, &places, status).map_err(|error| error.to_string())
            }
            Format::Junit => report::junit(&run, &report, &places, fail_on.into())
                .map_err(|error| error.to_string()),
            Format::Human => {
                let mut text = String::new();
                human::write(&report, style, &mut text).map_err(|error| error.to_string())?;
                Ok(text)
            }
        }
    };
    for file in &arguments.output {
        fs::write(file, render(Format::of_file(file))?)
            .map_err(|error| format!("{}: cannot be written: {error}", file.display()))?;
    }
    output::print(&render(arguments.format)?);
    Ok(status)
}

fn status(report: &Report) -> u8 {
    if report.count(Verdict::Incomplete) > 0 {
        INTERNAL
    } else if report.count(Verdict::Unreadable) == report.urdds.len() {
        USAGE
    } else if report.count(Verdict::Pass) == report.urdds.len() {
        CONFORMING
    } else {
        FINDINGS
    }
}

fn read_settings(arguments: &ValidateArguments) -> Result<Settings, String> {
    let default = PathBuf::from("urdd.toml");
    let file = match &arguments.config {
        Some(file) => Some(file),
        None => default.is_file().then_some(&default),
    };
    let mut settings = match file {
        None => Settings::default(),
        Some(file) => {
            let shown = file.display();
            let text = fs::read_to_string(file)
                .map_err(|error| format!("{shown}: cannot be read: {error}"))?;
            Settings::from_toml(&text).map_err(|error| format!("{shown}: {error}"))?
        }
    };
    if let Some(class) = &arguments.class {
        settings.class =
            Some(settings::parse_class(class).map_err(|error| format!("--class: {error}"))?);
    }
    settings.deep |= arguments.deep;
    if let Some(severity) = &arguments.fail_on {
        settings.fail_on = Some(
            settings::parse_severity(severity).map_err(|error| format!("--fail-on: {error}"))?,
        );
    }
    Ok(settings)
}
