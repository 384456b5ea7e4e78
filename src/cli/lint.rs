//! `urdd lint`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use similar::TextDiff;

use super::arguments::{LoopsArguments, PackageArguments, XacroArguments, split};
use super::output::{self, Color, Failure, about, one_line, shown};
use super::validate::{CONFORMING, FINDINGS, ReportArguments, status};
use super::watch::{Watch, Work};
use urdd_findings::baseline::Baseline;
use urdd_findings::settings::parse_program;
use urdd_findings::settings_file::{SETTINGS_FILE, SettingsFile};
use urdd_format::readable::counted;
use urdd_lint::{LeftAlone, LintSettings, Mended, declared};
use urdd_validate::Run;

/// Arguments of `urdd lint`.
#[derive(Args)]
#[command(
    after_help = "The rules are explained by `urdd explain LNT`, `urdd explain SRC`, and in docs/lint.md.\n\n\
    `<!-- urdd: allow LNT001 why -->` before an element allows a finding in it; [[ignore]] and [severity] in urdd.toml \
    are as for `urdd validate`.\n\n\
    --fix changes only files that are named, or are in a folder that is. It says which it leaves alone: links that lead \
    elsewhere, and, without --force, files that are read-only or have several names.\n\n\
    Exit status: 0 no findings at or above --fail-on, or nothing to change with --diff; 1 findings, or changes with \
    --diff; 2 usage error, nothing could be examined, or a file could not be written; 101 a rule crashed (a bug in this \
    program)."
)]
pub struct LintArguments {
    /// URDFs or xacro files, or folders with .urdf files at any depth (with --xacro, also .xacro files that are robots). `name:=value` is an argument for
    /// xacro.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,

    /// Mends what has one right answer, in the files, then reports what is left. Every other byte stays.
    #[arg(long)]
    fix: bool,

    /// Shows what --fix would change, and changes nothing.
    #[arg(long, conflicts_with = "fix")]
    diff: bool,

    /// With --fix or --diff: also files that are read-only, or have several names (hard links), of which the others keep
    /// the old text.
    #[arg(long)]
    force: bool,

    /// Leaves out the findings in this file, which --write-baseline made; in urdd.toml it is `baseline`.
    #[arg(long, value_name = "FILE")]
    baseline: Option<PathBuf>,

    /// Writes what is found into a file, for --baseline.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["baseline", "fix", "diff"])]
    write_baseline: Option<PathBuf>,

    /// Writes the robots that need arguments into urdd.toml (or the file of --config), with the values for which their
    /// packages have files, and lints nothing; where xacro may run, those values that make a robot. What is there stays.
    #[arg(long, conflicts_with_all = ["fix", "diff", "write_baseline"])]
    write_robots: bool,

    /// The programs that the URDFs are for, such as `ros,mujoco`: what these refuse is an error, what they read otherwise a
    /// warning, and what only others do an information. `urdd explain LNT060` says more; in urdd.toml it is `for`.
    #[arg(long = "for", value_name = "PROGRAMS", value_delimiter = ',', value_parser = parse_program)]
    programs: Vec<String>,

    #[command(flatten)]
    report: ReportArguments,

    #[command(flatten)]
    packages: PackageArguments,

    #[command(flatten)]
    named_loops: LoopsArguments,

    #[command(flatten)]
    xacro: XacroArguments,
}

pub fn run(arguments: &LintArguments, watch: &Watch, color: Color) -> Result<u8, Failure> {
    watch.run(Work::Robots, None, || lint(arguments, watch, color))
}

fn lint(arguments: &LintArguments, watch: &Watch, color: Color) -> Result<u8, Failure> {
    let file = arguments.report.settings_file()?;
    let robots = declared(&file).into();
    // A new one has all that is found.
    let usual = file.baseline.filter(|_| arguments.write_baseline.is_none());
    let baseline = arguments.baseline.as_deref().or(usual.as_deref());
    let mut settings = LintSettings {
        report: file.settings,
        source: urdd_source::Settings {
            robots,
            loops: arguments.named_loops.loops.clone(),
            ..arguments.packages.settings()?
        },
        baseline: baseline.map(Baseline::read).transpose()?.map(Arc::new),
        ..LintSettings::default()
    };
    if !arguments.programs.is_empty() {
        settings.report.programs.clone_from(&arguments.programs);
    }
    settings.source.cancellation = watch.cancellation();
    let (paths, xacro_arguments) = split(&arguments.paths);
    settings.source.xacro = arguments.xacro.settings(xacro_arguments);
    output::without_panic_messages(|| work(arguments, &paths, &settings, color))
}

fn work(
    arguments: &LintArguments,
    paths: &[PathBuf],
    settings: &LintSettings,
    color: Color,
) -> Result<u8, Failure> {
    if arguments.write_robots {
        return write_robots(arguments, paths, settings);
    }
    if arguments.fix || arguments.diff {
        let mended = urdd_lint::mend(paths, settings, arguments.force)?;
        if arguments.diff {
            return show(&mended);
        }
        write(&mended)?;
    }
    let run = urdd_lint::lint(paths, settings)?;
    run.asides.iter().for_each(|aside| output::error(aside));
    if let Some(file) = &arguments.write_baseline {
        return write_baseline(file, &run);
    }
    arguments.report.write(&run, &settings.report, true, color)
}

/// The file to write; says why if it is left alone.
fn target(mended: &Mended) -> Option<&Path> {
    let say =
        |why: &LeftAlone| output::error(&about(&mended.path)(format!("left as it is: {why}")));
    mended.target.as_deref().inspect_err(|why| say(why)).ok()
}

/// Prints what would change, as a patch. What is left alone is to be changed, too.
fn show(mended: &[Mended]) -> Result<u8, Failure> {
    let mut text = String::new();
    for one in mended.iter().filter(|one| target(one).is_some()) {
        let name = shown(&one.path);
        let diff = TextDiff::from_lines(&one.before, &one.after);
        text += &diff.unified_diff().header(&name, &name).to_string();
    }
    output::print(&text)?;
    Ok(u8::from(!mended.is_empty()))
}

/// Writes the mended files. A file that was changed meanwhile stays.
fn write(mended: &[Mended]) -> Result<(), Failure> {
    for one in mended {
        let Some(target) = target(one) else { continue };
        one.check(target).map_err(about(&one.path))?;
        output::write_file(target, &one.after)?;
        let places = counted(one.places, "place");
        output::error(&format!("mended {places} in {}", shown(&one.path)));
    }
    Ok(())
}

/// Adds the robots that need arguments to the settings file.
fn write_robots(
    arguments: &LintArguments,
    paths: &[PathBuf],
    settings: &LintSettings,
) -> Result<u8, Failure> {
    let file = arguments.report.config.as_deref().unwrap_or(Path::new(SETTINGS_FILE));
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    let (mut told, mut lines, mut count) = (String::new(), String::new(), 0);
    for one in urdd_lint::undeclared(paths, settings)? {
        let listed: Vec<String> = one.needed.iter().map(ToString::to_string).collect();
        let needs = format!("{}: needs {}", shown(&one.file), one_line(listed.join(", ")));
        match one.lines(folder) {
            Some(more) => {
                lines += &more;
                count += 1;
                told += &format!("{needs}\n");
            }
            None => {
                let words = "no value is known that makes a robot, so write the entry yourself";
                told += &format!("{needs}; {words}\n");
            }
        }
    }
    let done = match count {
        0 => "nothing to add".to_owned(),
        _ => {
            output::write_file(file, &SettingsFile::with_lines(file, &lines)?)?;
            format!("added {}", counted(count, "robot file"))
        }
    };
    output::print(&format!("{told}{}: {done}\n", shown(file)))?;
    Ok(0)
}

/// Writes a baseline. A file that is there must be one.
fn write_baseline(file: &Path, run: &Run) -> Result<u8, Failure> {
    if file.is_symlink() && !file.exists() {
        let words = "it is a link that leads nowhere; remove it, or name another file";
        return Err(about(file)(words).into());
    }
    if file.exists() {
        Baseline::read(file)?;
    }
    // What was not examined is in no baseline, and is said here: no later run will compare with it.
    for (urdf, why) in
        run.report.urdds.iter().filter_map(|urdf| Some((urdf, urdf.not_examined.as_ref()?)))
    {
        output::error(&format!("{}: not examined: {}", one_line(urdf.label()), why.reason));
    }
    let baseline = Baseline::of(run, file.parent().unwrap_or(Path::new(".")));
    let shown = shown(file);
    let status = status(&run.report);
    if status == output::USAGE {
        return Err(
            format!("{shown}: no robot could be examined, so no baseline is written").into()
        );
    }
    output::write_file(file, &baseline.to_json())?;
    let findings = counted(baseline.count(), "finding");
    output::print(&format!(
        "{shown}: {findings}, which `urdd lint --baseline {shown}` leaves out\n"
    ))?;
    // The findings are known now; what was not examined is not.
    let open = run.report.urdds.iter().filter_map(|urdf| urdf.not_examined.as_ref());
    let is_asked_for = open.into_iter().any(|why| why.is_asked_for);
    Ok(if status == FINDINGS && !is_asked_for { CONFORMING } else { status })
}
