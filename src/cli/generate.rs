//! `urdd generate`.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Args;

use super::generate_output::Printer;
use super::making::MakingArguments;
use super::output::{self, Failure, one_line};
use super::signals::{self, Signals};
use super::sources::{RobotArguments, split};
use urdd_directory::file_type::FileType;
use urdd_format::escape;
use urdd_generate::batch::{self, Observer, Shard};
use urdd_generate::{
    GenerateError, Generated, MAX_SOURCE_BYTES, Progress, Settings, generate_text,
};
use urdd_source::robots::{self, Batch, Job};

/// The argument for a URDF from standard input.
const STANDARD_INPUT: &str = "-";

/// Arguments of `urdd generate`.
#[derive(Args)]
#[command(
    after_help = "Mesh files are read from the URDF's folder (or the package, or the folder above `urdf/`, that contains it), from \
    packages, and from folders given by --allow-folder; a robot that names other files is refused. A .xacro file is \
    expanded by the program `xacro`.\n\n\
    Mesh names are resolved as in ROS: package:// by --package, by package.xml or a folder of that \
    name at or above the URDF, by ROS_PACKAGE_PATH and AMENT_PREFIX_PATH; file://, relative to the URDF, absolute.\n\n\
    Exit status: 0 every robot was generated; 1 some were not; 2 usage error, no robot was found, or results could not be \
    written; 130 or 143 stopped by a signal."
)]
pub struct GenerateArguments {
    /// A URDF or xacro file, or `-` for a URDF from standard input; several files, or folders of them, are a batch, and so
    /// is a file of which urdd.toml declares several robots. `name:=value` is an argument for xacro.
    #[arg(required = true, value_name = "ROBOT.urdf")]
    robots: Vec<PathBuf>,

    /// Folder of the URDD; for a batch, the folder that contains a URDD for each robot.
    #[arg(long, short, value_name = "DIR")]
    output: PathBuf,

    #[command(flatten)]
    making: MakingArguments,

    #[command(flatten)]
    declared: RobotArguments,

    /// Generates only the i-th of n parts of a batch.
    #[arg(long, value_name = "i/n")]
    shard: Option<Shard>,
}

/// Runs `urdd generate`. Returns the exit status, as the other commands do.
pub fn run(arguments: &GenerateArguments) -> Result<u8, Failure> {
    let stopped = "stopped by a signal; URDDs that were not finished are unchanged";
    signals::run(Some(stopped), |signals| {
        output::without_panic_messages(|| generate(arguments, signals))
    })
}

fn generate(arguments: &GenerateArguments, signals: &Signals) -> Result<u8, Failure> {
    let (robots, xacro_arguments) = split(&arguments.robots);
    let mut settings = arguments.making.settings(xacro_arguments, signals)?;
    settings.source.robots = arguments.declared.declared()?.into();
    let pool = arguments.making.pool()?;
    let are_several = robots::is_batch(&robots);
    if are_several && robots.iter().any(|path| path.as_os_str() == STANDARD_INPUT) {
        Err("`-` cannot be part of a batch: it reads one robot from standard input")?;
    }
    let mut found = match (robots::found(&robots, &settings.source), robots.as_slice()) {
        (Ok(found), _) => found,
        // What is wrong with a single file, its reader says.
        (Err(_), [file]) if !are_several => {
            Batch { jobs: vec![Job::new(file.clone(), String::new())], ..Batch::default() }
        }
        (Err(error), _) => Err(one_line(error))?,
    };
    let mut jobs = std::mem::take(&mut found.jobs);
    let is_batch = are_several || jobs.len() > 1;
    let printer = Printer::new(arguments.making.format, is_batch);
    let failed = if is_batch {
        check_used(arguments, &settings, jobs.iter().map(|job| job.source.as_path()))?;
        if let Some(shard) = arguments.shard {
            jobs = shard.of(jobs);
        }
        printer.begin_batch(jobs.len());
        let sieve = Sieve { printer: &printer, found: &found, parts: AtomicUsize::new(0) };
        let failed = pool.install(|| batch::run(&jobs, &arguments.output, &settings, &sieve));
        let parts = sieve.parts.into_inner();
        if signals.status().is_none() {
            printer.end(jobs.len() - parts, failed - parts);
        }
        found.asides(parts).iter().for_each(|aside| output::error(aside));
        failed - parts
    } else {
        if arguments.shard.is_some() {
            Err("--shard is for batches: give several robots, or a folder")?;
        }
        let job = jobs.pop().ok_or("no robot given; give a URDF or xacro file")?;
        check_used(arguments, &settings, [job.source.as_path()])?;
        let settings = Settings { source: job.settings(&settings.source), ..settings };
        one(job, &arguments.output, &settings, &pool, &printer)?
    };
    printer.status(failed > 0)
}

/// Passes on what becomes of robots, and counts the files that turn out to be parts of robots.
struct Sieve<'a> {
    printer: &'a Printer,
    found: &'a Batch,
    parts: AtomicUsize,
}

impl Observer for Sieve<'_> {
    fn begin(&self, job: &Job) -> Box<dyn Progress> {
        self.printer.begin(job)
    }

    fn done(&self, job: &Job, outcome: &Result<Generated, GenerateError>) {
        match outcome {
            Err(GenerateError::Source(error)) if self.found.is_part(&job.source, error) => {
                self.parts.fetch_add(1, Ordering::Relaxed);
            }
            outcome => self.printer.done(job, outcome),
        }
    }
}

/// Refuses xacro arguments if no file needs xacro, since they would have no effect.
fn check_used<'a>(
    arguments: &GenerateArguments,
    settings: &Settings,
    sources: impl IntoIterator<Item = &'a Path>,
) -> Result<(), String> {
    let is_expanded = |path: &Path| arguments.making.xacro.xacro || FileType::Xacro.is_of(path);
    match settings.source.xacro.arguments.first() {
        Some(unused) if !sources.into_iter().any(is_expanded) => Err(format!(
            "`{}` is an argument for xacro, but no .xacro file is given; `--xacro` also expands macros in .urdf files",
            escape::line(unused)
        )),
        _ => Ok(()),
    }
}

/// Generates a single robot, whose URDD is the output folder itself.
fn one(
    job: Job,
    output: &Path,
    settings: &Settings,
    pool: &rayon::ThreadPool,
    printer: &Printer,
) -> Result<usize, String> {
    let piped =
        if job.source.as_os_str() == STANDARD_INPUT { Some(standard_input()?) } else { None };
    let job = Job { name: output.display().to_string(), ..job };
    let progress = printer.begin(&job);
    let outcome = pool.install(|| {
        batch::caught(&job.source, || match piped {
            Some(urdf) => {
                generate_text(urdf, "standard input", Path::new("."), output, settings, &*progress)
            }
            None => urdd_generate::generate(&job.source, output, settings, &*progress),
        })
    });
    drop(progress);
    printer.done(&job, &outcome);
    Ok(usize::from(outcome.is_err()))
}

/// Reads standard input, up to one byte more than the maximum size of a URDF.
fn standard_input() -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let input = std::io::stdin().lock();
    input
        .take(MAX_SOURCE_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| format!("standard input cannot be read: {error}"))?;
    Ok(bytes)
}
