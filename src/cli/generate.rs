//! `urdd generate`.

use std::io::IsTerminal;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::generate_output::{Format, Printer};
use super::output;
use crate::format::escape;
use crate::format::meshes::GeometryKind;
use crate::generate::batch::{self, Job, Shard};
use crate::generate::{Packages, Selection, Settings};

/// Exit status: a robot could not be made.
const FAILED: u8 = 1;
/// Exit status: wrong usage, or there is no robot.
const USAGE: u8 = 2;

/// Arguments of `urdd generate`.
#[derive(Args)]
#[command(
    after_help = "Mesh names are looked up as ROS does: package:// by --package, by package.xml or a folder of that \
    name at or above the URDF, by ROS_PACKAGE_PATH and AMENT_PREFIX_PATH; file://, relative to the URDF, absolute.\n\n\
    Exit status: 0 every robot was made; 1 some were not; 2 wrong usage, no robot was found, \
    or results could not be written."
)]
pub struct GenerateArguments {
    /// A URDF or xacro file; or several, or folders of them, for a batch.
    #[arg(required = true, value_name = "ROBOT.urdf")]
    robots: Vec<PathBuf>,

    /// The folder of the URDD; of a batch, the folder that gets a URDD for each robot.
    #[arg(long, short, value_name = "DIR")]
    output: PathBuf,

    /// Modules to make besides the core class, or classes (core, geometry, shapes), separated by commas; what they are
    /// derived from is made too. Without it, all.
    #[arg(long, value_name = "MODULES", value_delimiter = ',')]
    modules: Vec<String>,

    /// Where a ROS package is; may be given again.
    #[arg(long = "package", value_name = "NAME=PATH")]
    packages: Vec<String>,

    /// Which geometry links are made from; a link that has none of it gets the other.
    #[arg(long, value_enum, default_value_t = Preferred::Visual)]
    geometry: Preferred,

    /// Sampled configurations of the distance statistics, 100,000 at most.
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    samples: u32,

    /// Threads; without it, one for each processor. The URDD is the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,

    /// Writes into a folder that holds something else than a URDD of this program. Files of other names stay.
    #[arg(long)]
    force: bool,

    /// How results are written to standard output.
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,

    /// Of a batch, only the i-th of n parts.
    #[arg(long, value_name = "i/n")]
    shard: Option<Shard>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Preferred {
    /// The visual elements.
    Visual,
    /// The collision elements.
    Collision,
}

/// Runs `urdd generate`.
pub fn run(arguments: &GenerateArguments) -> ExitCode {
    match generate(arguments) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::from(FAILED),
        Err(message) => {
            output::error(&message);
            ExitCode::from(USAGE)
        }
    }
}

/// Gives how many robots could not be made.
fn generate(arguments: &GenerateArguments) -> Result<usize, String> {
    let settings = settings(arguments)?;
    let mut pool = rayon::ThreadPoolBuilder::new();
    if let Some(threads) = arguments.threads {
        pool = pool.num_threads(threads.into());
    }
    let pool = pool.build().map_err(|error| error.to_string())?;
    // A crash is caught and reported; the default hook would print besides.
    std::panic::set_hook(Box::new(|_| {}));
    let is_batch = batch::is_batch(&arguments.robots);
    let printer = Printer::new(
        arguments.format,
        is_batch,
        std::io::stderr().is_terminal() && !output::is_dumb(),
    );
    let failed = if is_batch {
        let mut jobs = batch::jobs(&arguments.robots)
            .map_err(|error| escape::line(&error.to_string()).into_owned())?;
        if let Some(shard) = arguments.shard {
            jobs = shard.of(jobs);
        }
        printer.begin(jobs.len());
        let failed = pool.install(|| batch::run(&jobs, &arguments.output, &settings, &printer));
        printer.end(jobs.len(), failed);
        failed
    } else {
        if arguments.shard.is_some() {
            return Err("--shard is for batches: give several robots, or a folder".to_owned());
        }
        one(arguments, &settings, &pool, &printer)
    };
    let _ = std::panic::take_hook();
    match printer.unprinted() {
        Some(message) => Err(message),
        None => Ok(failed),
    }
}

/// A single robot, whose URDD is the output folder itself.
fn one(
    arguments: &GenerateArguments,
    settings: &Settings,
    pool: &rayon::ThreadPool,
    printer: &Printer,
) -> usize {
    use crate::generate::batch::Observer;
    let job = Job {
        source: arguments.robots.first().cloned().unwrap_or_default(),
        name: arguments.output.display().to_string(),
    };
    let progress = printer.begin_robot(&job);
    let outcome =
        pool.install(|| batch::caught(&job.source, &arguments.output, settings, &*progress));
    drop(progress);
    printer.done(&job, &outcome);
    usize::from(outcome.is_err())
}

fn settings(arguments: &GenerateArguments) -> Result<Settings, String> {
    let selection = match arguments.modules.is_empty() {
        true => Selection::all(),
        false => Selection::parse(arguments.modules.iter().map(String::as_str))
            .map_err(|error| format!("--modules: {error}"))?,
    };
    let mut packages = Packages::from_environment(|name| std::env::var_os(name));
    for argument in &arguments.packages {
        packages
            .add(argument)
            .map_err(|error| format!("--package: {error}"))?;
    }
    Ok(Settings {
        selection,
        packages,
        preferred_geometry: match arguments.geometry {
            Preferred::Visual => GeometryKind::Visual,
            Preferred::Collision => GeometryKind::Collision,
        },
        num_samples: arguments.samples,
        force: arguments.force,
    })
}
