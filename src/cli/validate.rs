//! `urdd validate`.

use std::path::PathBuf;

use clap::Args;

use super::inputs::advice;
use super::output::{self, Color, Failure};
use super::reporting::ReportArguments;
use super::words::Class;
use urdd_validate::{ValidateError, rules};

/// Arguments of `urdd validate`.
#[derive(Args)]
#[command(
    after_help = "Exit status: 0 conforming; 1 findings at or above --fail-on; 2 usage error, nothing could be \
    examined, or a report could not be written; 101 a rule crashed (a bug in this program)."
)]
pub struct ValidateArguments {
    /// URDDs, or folders with URDDs at any depth.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,

    #[command(flatten)]
    report: ReportArguments,

    /// Conformance class that every URDD must meet.
    #[arg(long, value_name = "CLASS", ignore_case = true)]
    class: Option<Class>,

    /// Recomputes sampled data (distance statistics) in full, however long it takes.
    #[arg(long)]
    deep: bool,

    /// Also runs a rule that crashes, to show how crashes are reported.
    #[arg(long, hide = true)]
    with_crashing_rule: bool,
}

/// Runs `urdd validate`.
pub fn run(arguments: &ValidateArguments, color: Color) -> Result<u8, Failure> {
    let mut settings = arguments.report.settings_file()?.settings;
    settings.class = arguments.class.map(Into::into).or(settings.class);
    settings.deep |= arguments.deep;
    let mut rules = rules::all();
    if arguments.with_crashing_rule {
        rules.push(rules::testing::CRASHING);
    }
    let run = output::without_panic_messages(|| {
        urdd_validate::validate_with(&arguments.paths, &settings, &rules)
    });
    let run = run.map_err(|error| match error {
        ValidateError::Discover(error) => advice(&error),
        error => error.to_string(),
    });
    arguments.report.write(&run?, &settings, false, color)
}
