//! `urdd diff`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::foreign;
use super::output;
use super::signals::Signals;
use crate::diff::{DiffError, Options, Side, compare, markdown, text};
use urdd_format::escape;
use urdd_generate::{Packages, Settings};
use urdd_validate::report;

/// Exit status: the robots differ.
const DIFFERENT: u8 = 1;

/// Arguments of `urdd diff`.
#[derive(Args)]
#[command(
    after_help = "Compared by meaning: formatting, comments, the order of attributes, how a number is written and the format \
    of mesh files make no difference. docs/diff.md says what is compared, and how.\n\n\
    Exit status: 0 no difference; 1 different; 2 usage error, or one of the robots could not be read."
)]
pub struct DiffArguments {
    /// The robot before: a URDF, or a URDD (a folder or a zip archive).
    #[arg(value_name = "A")]
    before: PathBuf,

    /// The robot after.
    #[arg(value_name = "B")]
    after: PathBuf,

    /// Output format.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,

    /// Leaves out findings. Validating both robots takes most of the time.
    #[arg(long)]
    no_findings: bool,

    /// For a URDF: folder of a ROS package. May be repeated.
    #[arg(long = "package", value_name = "NAME=PATH")]
    packages: Vec<String>,

    /// For a URDF: additional folder that mesh files may be read from, besides those of the robot and its packages. May be
    /// repeated.
    #[arg(long = "allow-folder", value_name = "DIR")]
    allowed_folders: Vec<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Text for people.
    Text,
    /// JSON; its schema is `urdd schema show diff_report@1.0.0`.
    Json,
    /// Markdown, for a comment on a pull request.
    Markdown,
}

/// Runs `urdd diff`.
pub fn run(arguments: &DiffArguments) -> ExitCode {
    output::ended(diff(arguments))
}

fn diff(arguments: &DiffArguments) -> Result<u8, String> {
    let signals = Signals::listen().map_err(|error| error.to_string())?;
    let options = Options {
        urdf: settings(arguments, &signals)?,
        without_findings: arguments.no_findings,
    };
    let open = |path: &PathBuf| {
        Side::open(path, &options).map_err(|error| match error {
            DiffError::Discover(error) => foreign::advice(&error),
            error => error.to_string(),
        })
    };
    // A panic of a rule is caught and reported; the default hook would print it as well.
    std::panic::set_hook(Box::new(|_| {}));
    let sides = (open(&arguments.before), open(&arguments.after));
    let _ = std::panic::take_hook();
    if let Some(status) = signals.status() {
        return Ok(status);
    }
    let (before, after) = match sides {
        (Ok(before), Ok(after)) => (before, after),
        // Both messages, so that both can be mended at once.
        (Err(a), Err(b)) if a != b => return Err(format!("{a}\nurdd: {b}")),
        (Err(error), _) | (_, Err(error)) => return Err(error),
    };
    let found = compare(&before, &after);
    match arguments.format {
        Format::Text => output::print(&text(&found))?,
        Format::Markdown => output::print_raw(&markdown(&found))?,
        Format::Json => {
            let json = report::json(&found).map_err(|error| error.to_string())?;
            output::print(&json)?;
        }
    }
    Ok(if found.same { 0 } else { DIFFERENT })
}

fn settings(arguments: &DiffArguments, signals: &Signals) -> Result<Settings, String> {
    let mut packages = Packages::from_environment(|name| std::env::var_os(name));
    for argument in &arguments.packages {
        let added = packages.add(argument);
        added.map_err(|error| format!("--package: {}", escape::line(&error.to_string())))?;
    }
    for folder in &arguments.allowed_folders {
        if !folder.is_dir() {
            let folder = folder.display().to_string();
            let folder = escape::line(&folder);
            return Err(format!("--allow-folder: {folder} is not a folder"));
        }
    }
    Ok(Settings {
        packages,
        allowed_folders: arguments.allowed_folders.clone(),
        cancellation: signals.cancellation(),
        ..Settings::default()
    })
}
