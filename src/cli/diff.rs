//! `urdd diff`.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::arguments::{
    LoopsArguments, PackageArguments, RobotArguments, XacroArguments, only_arguments,
};
use super::inputs::advice;
use super::output::{self, Failure, one_line};
use super::watch::Watch;
use urdd_diff::{
    DiffError, Folder, Options, Side, TOLERANCE, compare, compare_folders, folders_json,
    folders_markdown, folders_text, markdown, status, text,
};
use urdd_directory::cancellation::Cancellation;
use urdd_findings::settings_file::{SETTINGS_FILE, SettingsFile};
use urdd_lint::declared;
use urdd_source::{Settings, XacroSettings, format_of};
use urdd_validate::report;

/// Arguments of `urdd diff`.
#[derive(Args)]
#[command(
    after_help = "Compared by meaning: formatting, comments, the order of attributes, how a number is written and the format \
    of mesh files make no difference. docs/diff.md says what is compared, and how.\n\n\
    Exit status: 0 no difference; 1 different, or a robot is in one folder alone; 2 usage error, or one of the robots could not \
    be read."
)]
pub struct DiffArguments {
    /// The robot before: a URDF, a xacro file, an MJCF, SDF or USD, or a URDD (a folder or a zip archive). Of two folders with an
    /// urdd.toml each, all robots are compared.
    #[arg(value_name = "A")]
    before: PathBuf,

    /// The robot after.
    #[arg(value_name = "B")]
    after: PathBuf,

    /// An argument for xacro, for both robots.
    #[arg(value_name = "NAME:=VALUE")]
    more: Vec<PathBuf>,

    /// Output format.
    #[arg(long, value_enum, default_value_t = DiffFormat::Text)]
    format: DiffFormat,

    /// Leaves out findings. Validating both robots takes most of the time.
    #[arg(long)]
    no_findings: bool,

    /// Takes numbers that differ by at most this, in the unit of each value, as equal. Meshes are compared exactly.
    #[arg(long, value_name = "NUMBER", default_value_t = 0.0, value_parser = |word: &str| TOLERANCE.parse::<f64>(word))]
    tolerance: f64,

    #[command(flatten)]
    packages: PackageArguments,

    #[command(flatten)]
    named_loops: LoopsArguments,

    #[command(flatten)]
    xacro: XacroArguments,

    #[command(flatten)]
    declared: RobotArguments,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DiffFormat {
    /// Text for people.
    Text,
    /// JSON; its schema is `urdd schema show diff_report@1.3.0`.
    Json,
    /// Markdown, for a comment on a pull request.
    Markdown,
}

impl DiffArguments {
    /// The two folders with their settings files, if both have one.
    fn folders(&self) -> Result<Option<[(&Path, SettingsFile); 2]>, Failure> {
        let files = [&self.before, &self.after].map(|folder| folder.join(SETTINGS_FILE));
        let [before, after] = &files;
        if !before.is_file() || !after.is_file() {
            return Ok(None);
        }
        let (before, after) = (SettingsFile::read(before)?, SettingsFile::read(after)?);
        Ok(Some([(&self.before, before), (&self.after, after)]))
    }

    /// How xacro expands A and B: with the arguments on the command line; without any, with those that are declared of each,
    /// which it has to take. Where nobody declares A, as a temporary file of git, it is another version of B.
    fn of_xacro(&self) -> Result<[XacroSettings; 2], Failure> {
        let given = only_arguments(&self.more)?;
        if !given.is_empty() {
            return Ok([given.clone(), given].map(|given| self.xacro.settings(given)));
        }
        let declared =
            |of: Vec<String>| XacroSettings { declared: of.len(), ..self.xacro.settings(of) };
        let after = self.declared.arguments_of(&self.after)?.unwrap_or_default();
        let before = match self.declared.arguments_of(&self.before)? {
            Some(before) => declared(before),
            None => self.xacro.settings(after.clone()),
        };
        Ok([before, declared(after)])
    }
}

/// Compares the robots of two folders, each with its own settings file.
fn diff_folders(
    arguments: &DiffArguments,
    folders: [(&Path, SettingsFile); 2],
    settings: &Settings,
) -> Result<u8, Failure> {
    let words = only_arguments(&arguments.more)?;
    let open = |(folder, file): (&Path, SettingsFile)| {
        let settings = Settings {
            robots: declared(&file).into(),
            xacro: arguments.xacro.settings(words.clone()),
            ..settings.clone()
        };
        let excludes = &file.settings.excludes;
        Folder::open(folder, settings, |path| excludes.iter().any(|one| one.matches(path)))
            .map_err(one_line)
    };
    let [before, after] = folders.map(open);
    let (before, after) = (before?, after?);
    let found = output::without_panic_messages(|| {
        compare_folders(&before, &after, arguments.no_findings, arguments.tolerance)
    })?;
    match arguments.format {
        DiffFormat::Text => output::print(&folders_text(&found))?,
        DiffFormat::Markdown => output::print_raw(&folders_markdown(&found))?,
        DiffFormat::Json => output::print(&report::json(&folders_json(&found)?)?)?,
    }
    Ok(status(&found))
}

pub fn run(arguments: &DiffArguments, watch: &Watch) -> Result<u8, Failure> {
    watch.run_one(&arguments.after, None, |cancellation| diff(arguments, cancellation))
}

fn diff(arguments: &DiffArguments, cancellation: &Cancellation) -> Result<u8, Failure> {
    let settings = Settings {
        loops: arguments.named_loops.loops.clone(),
        cancellation: cancellation.clone(),
        ..arguments.packages.settings()?
    };
    // It is about the URDF of the two.
    let says_itself = |path: &Path| format_of(path, &settings.files).is_some();
    let is_of_one = says_itself(&arguments.before) != says_itself(&arguments.after);
    if let Some(folders) = arguments.folders()? {
        return diff_folders(arguments, folders, &settings);
    }
    let [of_before, of_after] = arguments.of_xacro()?;
    let open = |path: &PathBuf, xacro: XacroSettings| {
        let loops = settings.loops.clone().filter(|_| !(is_of_one && says_itself(path)));
        let options = Options {
            urdf: Settings { loops, xacro, ..settings.clone() },
            without_findings: arguments.no_findings,
        };
        Side::open(path, &options).map_err(|error| match error {
            DiffError::Discover(error) => advice(&error),
            error => error.to_string(),
        })
    };
    let sides = output::without_panic_messages(|| {
        (open(&arguments.before, of_before), open(&arguments.after, of_after))
    });
    cancellation.check()?;
    let (before, after) = match sides {
        (Ok(before), Ok(after)) => (before, after),
        // Both messages, so that both can be mended at once.
        (Err(a), Err(b)) if a != b => return Err(format!("{a}\nurdd: {b}").into()),
        (Err(error), _) | (_, Err(error)) => return Err(error.into()),
    };
    let found = compare(&before, &after, arguments.tolerance)?;
    cancellation.check()?;
    match arguments.format {
        DiffFormat::Text => output::print(&text(&found))?,
        DiffFormat::Markdown => output::print_raw(&markdown(&found))?,
        DiffFormat::Json => output::print(&report::json(&found)?)?,
    }
    Ok(u8::from(!found.same))
}
