//! `urdd validate`, and the arguments and the report that it shares with `urdd lint`.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::arguments::{Class, Level, settings_file};
use super::inputs::advice;
use super::output::{self, Color, Failure};
use super::watch::{Watch, Work};
use urdd_directory::outputs::check_name;
use urdd_format::report::{Report, Severity, Verdict};
use urdd_validate::report::place::places;
use urdd_validate::report::style::Style;
use urdd_validate::report::{self, human};
use urdd_validate::selection::Codes;
use urdd_validate::settings::{Exclude, Settings};
use urdd_validate::settings_file::SettingsFile;
use urdd_validate::{Run, ValidateError, rules};

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

    /// Also runs a rule that takes ten minutes for a robot named `slow`, to show how limits are kept.
    #[arg(long, hide = true)]
    with_slow_rule: bool,
}

pub fn run(arguments: &ValidateArguments, watch: &Watch, color: Color) -> Result<u8, Failure> {
    watch.run(Work::Robots, None, || validate(arguments, watch, color))
}

fn validate(arguments: &ValidateArguments, watch: &Watch, color: Color) -> Result<u8, Failure> {
    let mut settings = arguments.report.settings_file()?.settings;
    settings.cancellation = watch.cancellation();
    settings.class = arguments.class.map(Into::into).or(settings.class);
    settings.deep |= arguments.deep;
    let mut rules = rules::all();
    if arguments.with_crashing_rule {
        rules.push(rules::testing::CRASHING);
    }
    if arguments.with_slow_rule {
        rules.push(rules::testing::SLOW);
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

/// Exit status: conforming.
pub(super) const CONFORMING: u8 = 0;
/// Exit status: findings.
pub(super) const FINDINGS: u8 = 1;
/// Exit status: a rule panicked.
const INTERNAL: u8 = 101;

/// What is reported, and how.
#[derive(Args)]
pub(super) struct ReportArguments {
    /// Format of the report on standard output.
    #[arg(long, value_enum, default_value_t = ReportFormat::Human)]
    format: ReportFormat,

    /// Also writes the report to a file, in the format of the file's extension: .sarif, .xml (JUnit), .md (a summary),
    /// otherwise JSON. May be repeated.
    #[arg(long, alias = "report", value_name = "FILE")]
    output: Vec<PathBuf>,

    /// Lowest severity of findings that fails the run; default: `error`.
    #[arg(long, value_name = "SEVERITY")]
    fail_on: Option<Level>,

    /// Settings file; default: urdd.toml in the current folder, if it exists.
    #[arg(long, value_name = "FILE")]
    pub(super) config: Option<PathBuf>,

    /// Leaves out folders with this path, relative to the given path; `*` and `**` as in .gitignore.
    /// May be repeated; in urdd.toml it is `exclude`.
    #[arg(long, value_name = "GLOB")]
    exclude: Vec<String>,

    /// Reports these rules only: codes or families (MSH, DOF003), separated by commas.
    #[arg(long, value_name = "CODES", value_delimiter = ',')]
    select: Vec<Codes>,

    /// Leaves out these rules: codes or families.
    #[arg(long, value_name = "CODES", value_delimiter = ',')]
    ignore: Vec<Codes>,

    /// Shows every URDD in full; by default, more than three are summarized.
    #[arg(long)]
    full: bool,

    /// Maximum number of places shown per finding in the human format; the other formats list all.
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    max_places: u16,

    /// Leaves out URDDs without findings.
    #[arg(long, short)]
    quiet: bool,
}

/// How a report is written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ReportFormat {
    /// Text for people.
    Human,
    /// JSON; its schema is `urdd schema show report@1.2.0`.
    Json,
    /// SARIF 2.1.0, for GitHub code scanning and editors. Run at the root of the repository.
    Sarif,
    /// Workflow commands of GitHub Actions: annotations in pull requests, without an upload.
    Github,
    /// JUnit XML, for tools that show test results: a suite for each URDD, a case for each rule.
    Junit,
    /// A summary as Markdown, for the page of a run of GitHub Actions.
    Markdown,
}

impl ReportFormat {
    fn of_file(file: &Path) -> ReportFormat {
        let name = file.to_string_lossy().to_ascii_lowercase();
        if name.ends_with(".sarif") || name.ends_with(".sarif.json") {
            ReportFormat::Sarif
        } else if name.ends_with(".xml") {
            ReportFormat::Junit
        } else if name.ends_with(".md") {
            ReportFormat::Markdown
        } else {
            ReportFormat::Json
        }
    }
}

impl ReportArguments {
    /// The settings file, with what the command line sets.
    pub(super) fn settings_file(&self) -> Result<SettingsFile, Failure> {
        for file in &self.output {
            check_name(file)?;
        }
        let mut read = settings_file(self.config.as_deref())?;
        let settings = &mut read.settings;
        for pattern in &self.exclude {
            let exclude = Exclude::new(pattern).map_err(|error| format!("--exclude: {error}"))?;
            settings.excludes.push(exclude);
        }
        settings.selection.select.clone_from(&self.select);
        settings.selection.ignore.clone_from(&self.ignore);
        settings.fail_on = self.fail_on.map(Into::into).or(settings.fail_on);
        Ok(read)
    }

    /// Writes the report to standard output and to the files; returns the exit status. `is_lint`: what `urdd lint` says
    /// need not point to it.
    pub(super) fn write(
        &self,
        run: &Run,
        settings: &Settings,
        is_lint: bool,
        color: Color,
    ) -> Result<u8, Failure> {
        // Parts of robots alone are no fault.
        if run.report.urdds.is_empty() && run.excluded > 0 {
            let excluded = run.excluded;
            Err(format!("nothing to examine: everything found ({excluded}) is excluded"))?;
        }
        let report = &run.report;
        let status = status(report);
        let current = std::env::current_dir().unwrap_or_default();
        let places = places(run, &current);
        let style = Style {
            color: color.on(std::io::stdout().is_terminal()),
            quiet: self.quiet,
            full: self.full,
            max_places: self.max_places.into(),
            suggests_lint: !is_lint,
            width: output::width().unwrap_or(Style::default().width),
        };
        let render = |format: ReportFormat| -> Result<String, Failure> {
            let mut text = String::new();
            match format {
                ReportFormat::Json => text = report::json(report)?,
                ReportFormat::Sarif => text = report::sarif(run, &places, status)?,
                ReportFormat::Junit => {
                    let fail_on = settings.fail_on.unwrap_or(Severity::Error);
                    text = report::junit(run, &places, fail_on)?;
                }
                ReportFormat::Github => report::github(report, &places, &mut text)?,
                ReportFormat::Markdown => report::markdown(report, &mut text)?,
                ReportFormat::Human => human::write(report, style, &mut text)?,
            }
            Ok(text)
        };
        // A failed file does not keep the others from being written.
        let mut failures = Vec::new();
        for file in &self.output {
            let text = render(ReportFormat::of_file(file))?;
            failures.extend(output::write_file(file, &text).err());
        }
        let text = render(self.format)?;
        let printed = match self.format {
            ReportFormat::Github => {
                let people = render(ReportFormat::Human)?;
                output::print_raw(&text).and_then(|()| output::print(&people))
            }
            _ => output::print(&text),
        };
        failures.extend(printed.err());
        if failures.is_empty() { Ok(status) } else { Err(failures.join("\nurdd: ").into()) }
    }
}

/// The exit status of a run. Where nothing was examined it is that of nothing to examine.
pub(super) fn status(report: &Report) -> u8 {
    let totals = &report.totals;
    let mut open = report.urdds.iter().filter_map(|urdd| urdd.not_examined.as_ref());
    if report.count(Verdict::Incomplete) > 0 {
        INTERNAL
    } else if totals.not_examined == totals.urdds && totals.urdds.get() > 0 {
        output::USAGE
    } else if totals.failed.get() > 0 || open.any(|why| why.is_asked_for) {
        FINDINGS
    } else {
        CONFORMING
    }
}
