//! `urdd import`.

use std::path::PathBuf;

use clap::Args;

use super::arguments::{AnswerFormat, PackageArguments};
use super::output::{self, Failure, shown};
use super::watch::Watch;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::outputs::{Output, Target};
use urdd_format::readable::counted;
use urdd_import::{Imported, import_whole};
use urdd_source::Settings;

/// Maximum number of notes that are printed; the report has all.
const MAX_NOTES: usize = 20;

/// Arguments of `urdd import`.
#[derive(Args)]
#[command(
    after_help = "Writes NAME.urdf with its meshes, and where they say something NAME.srdf (named configurations, pairs that never \
    collide), NAME.export.toml (kind of base, gains) and NAME.loops.toml (loops and couplings). The format is told by the content of the file. `urdd generate`, \
    `view`, `diff`, `lint` and `combine` take MJCF, SDF and USD directly.\n\n\
    Exit status: 0 the files are written; 2 the file cannot be imported or written."
)]
pub struct ImportArguments {
    /// An MJCF, SDF or USD file.
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// The folder for the files.
    #[arg(long, short, value_name = "FOLDER")]
    output: PathBuf,

    /// Writes what was carried, carried otherwise and lost of this robot to a file, as JSON.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,

    /// Format of the answer on standard output.
    #[arg(long, value_enum, default_value_t = AnswerFormat::Human)]
    format: AnswerFormat,

    /// Overwrites existing files.
    #[arg(long)]
    force: bool,

    #[command(flatten)]
    packages: PackageArguments,
}

/// Runs `urdd import`.
pub fn run(arguments: &ImportArguments, watch: &Watch) -> Result<u8, Failure> {
    watch.run_one(&arguments.file, None, |cancellation| {
        output::print(&imported(arguments, cancellation)?)?;
        Ok(0)
    })
}

/// Imports, and returns what to print.
fn imported(arguments: &ImportArguments, cancellation: &Cancellation) -> Result<String, Failure> {
    let settings =
        Settings { cancellation: cancellation.clone(), ..arguments.packages.settings()? };
    let (imported, source) = import_whole(&arguments.file, &settings)?;
    let robot = &source.reading.robot;
    let report = arguments.report.as_ref().map(|file| (file, imported.report.to_json()));
    let files = imported.files.iter();
    let files = files.map(|(name, bytes)| {
        let (path, replaces) = (name.into(), arguments.force);
        Output { path, bytes, replaces }
    });
    let mut files: Vec<Output> = files.collect();
    // The file that names the others is last.
    files.sort_by_key(|file| file.path.as_os_str() == imported.urdf.as_str());
    let count = files.len() + usize::from(report.is_some());
    let report = report.as_ref().map(|(file, text)| (file.as_path(), text.as_bytes()));
    output::write_files(Target::Folder(&arguments.output), files, report, arguments.force, "")?;
    let left = imported.left_in(&arguments.output).into_iter().map(|left| format!("note: {left}"));
    for note in notes(&imported).into_iter().chain(left) {
        output::error(&note);
    }
    let [links, joints] = [(robot.links.len(), "link"), (robot.joints.len(), "joint")]
        .map(|(count, thing)| counted(count, thing));
    if arguments.format == AnswerFormat::Json {
        return Ok(imported.report.to_json());
    }
    let urdf = shown(&arguments.output.join(&imported.urdf));
    Ok(format!("{urdf}: {links}, {joints}, {}\n", counted(count, "file")))
}

/// What is lost, what is otherwise, and what else a person has to know.
fn notes(imported: &Imported) -> Vec<String> {
    let notes = imported.report.notes(&imported.shown);
    let more = notes.len().saturating_sub(MAX_NOTES);
    let mut lines: Vec<String> =
        notes.iter().take(MAX_NOTES).map(|note| format!("note: {note}")).collect();
    if more > 0 {
        lines.push(format!("note: and {more} more; --report FILE writes all"));
    }
    lines
}
