//! `urdd lint`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::output::{self, Color};
use super::packages::PackageArguments;
use super::reporting::ReportArguments;
use super::signals::Signals;
use super::xacro::{self, XacroArguments};
use urdd_lint::LintSettings;

/// Arguments of `urdd lint`.
#[derive(Args)]
#[command(
    after_help = "The rules are explained by `urdd explain LNT`, `urdd explain SRC`, and in docs/lint.md.\n\n\
    Exit status: 0 no findings at or above --fail-on; 1 findings; 2 usage error, nothing could be examined, or a report \
    could not be written; 101 a rule crashed (a bug in this program)."
)]
pub struct LintArguments {
    /// URDFs or xacro files, or folders with .urdf and .urdf.xacro files at any depth. `name:=value` is an argument for
    /// xacro.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,

    #[command(flatten)]
    report: ReportArguments,

    #[command(flatten)]
    packages: PackageArguments,

    #[command(flatten)]
    xacro: XacroArguments,
}

/// Runs `urdd lint`.
pub fn run(arguments: &LintArguments, color: Color) -> ExitCode {
    output::ended(lint(arguments, color))
}

fn lint(arguments: &LintArguments, color: Color) -> Result<u8, String> {
    let signals = Signals::listen().map_err(|error| error.to_string())?;
    let mut settings = LintSettings {
        report: arguments.report.settings()?,
        source: arguments.packages.settings(&signals)?,
    };
    settings.report.cancellation = signals.cancellation();
    let (paths, xacro_arguments) = xacro::split(&arguments.paths);
    settings.source.xacro = arguments.xacro.settings(xacro_arguments);
    // A panic of a rule is caught and reported; the default hook would print it as well.
    std::panic::set_hook(Box::new(|_| {}));
    let run = urdd_lint::lint(&paths, &settings).map_err(|error| error.to_string());
    let _ = std::panic::take_hook();
    if let Some(status) = signals.status() {
        return Ok(status);
    }
    arguments.report.write(&run?, &settings.report, color)
}
