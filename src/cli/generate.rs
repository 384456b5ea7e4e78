//! `urdd generate`.

use std::io::{IsTerminal, Read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use clap::{Args, ValueEnum};

use super::generate_output::{Format, Printer};
use super::output;
use super::signals::Signals;
use crate::format::escape;
use crate::format::link_shapes_skips::SkippedReason;
use crate::format::meshes::GeometryKind;
use crate::generate::batch::{self, Job, Shard};
use crate::generate::{
    MAX_SOURCE_BYTES, MeshFormats, Packages, Pieces, Selection, Settings, XacroSettings,
    generate_text,
};

/// Exit status: a robot could not be made.
const FAILED: u8 = 1;
/// Exit status: wrong usage, or there is no robot.
const USAGE: u8 = 2;

/// The word for a URDF from standard input.
const STANDARD_INPUT: &str = "-";

/// Arguments of `urdd generate`.
#[derive(Args)]
#[command(
    after_help = "Mesh files are taken from the URDF's folder (or the package, or the folder above `urdf/`, that it lies in), from \
    packages, and from folders that --allow-folder names; a robot that names other files is refused. A .xacro file is \
    expanded by the program `xacro`.\n\n\
    Mesh names are looked up as ROS does: package:// by --package, by package.xml or a folder of that \
    name at or above the URDF, by ROS_PACKAGE_PATH and AMENT_PREFIX_PATH; file://, relative to the URDF, absolute.\n\n\
    Exit status: 0 every robot was made; 1 some were not; 2 wrong usage, no robot was found, or results could not be \
    written; 130 or 143 stopped by a signal."
)]
pub struct GenerateArguments {
    /// A URDF or xacro file, or `-` for a URDF from standard input; or several, or folders of them, for a batch. A word
    /// `name:=value` is an argument for xacro.
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

    /// A folder besides those of the robot and its packages from which mesh files may be taken; may be given again.
    #[arg(long = "allow-folder", value_name = "DIR")]
    allowed_folders: Vec<PathBuf>,

    /// Which geometry links are made from; a link that has none of it gets the other.
    #[arg(long, value_enum, default_value_t = Preferred::Visual)]
    geometry: Preferred,

    /// The files of each plain mesh, hull and piece, separated by commas. The .glb is always made; `glb` alone makes a
    /// URDD about half as large.
    #[arg(
        long,
        value_enum,
        value_name = "FORMATS",
        value_delimiter = ',',
        default_value = "glb,stl,obj"
    )]
    mesh_formats: Vec<MeshFormat>,

    /// Most convex pieces of a link.
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u8).range(1..=64))]
    pieces: u8,

    /// A link gets no more pieces than are needed for this mean distance from their outside to its surface, metres.
    /// Without it, as many as save enough, of small links and large ones alike.
    #[arg(long, value_name = "METRES", value_parser = length)]
    piece_tolerance: Option<f64>,

    /// Sampled configurations of the distance statistics, 100,000 at most.
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    samples: u32,

    /// For which reasons pairs of shapes are skipped in collision checks, separated by commas. Without it, those of the
    /// URDD that is replaced; of a new one same-link, always, adjacent and default. `never` rests on samples alone.
    #[arg(long, value_enum, value_name = "REASONS", value_delimiter = ',')]
    skip: Option<Vec<Skip>>,

    /// Threads; without it, one for each processor. The URDD is the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,

    /// Makes nothing of a robot of which a mesh is not found, or anything has to be assumed that changes it.
    #[arg(long)]
    strict: bool,

    /// Expands macros in .urdf files too.
    #[arg(long)]
    xacro: bool,

    /// How long xacro may take for a file, seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..))]
    xacro_timeout: u32,

    /// Drops the edits of skips in the URDD that is replaced; without it, a new run keeps them, or stops where it cannot.
    #[arg(long)]
    drop_edits: bool,

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

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum MeshFormat {
    /// Binary glTF, with colours, normals and textures.
    Glb,
    /// Binary STL.
    Stl,
    /// Wavefront OBJ.
    Obj,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Skip {
    /// Both shapes are on one link.
    SameLink,
    /// In contact in every sampled configuration.
    Always,
    /// A joint connects the two links.
    Adjacent,
    /// In contact in the default configuration: zero, clamped to the bounds.
    Default,
    /// In contact in no sampled configuration.
    Never,
}

impl From<Skip> for SkippedReason {
    fn from(skip: Skip) -> Self {
        match skip {
            Skip::SameLink => SkippedReason::SameLink,
            Skip::Always => SkippedReason::Always,
            Skip::Adjacent => SkippedReason::Adjacent,
            Skip::Default => SkippedReason::Default,
            Skip::Never => SkippedReason::Never,
        }
    }
}

/// A length in metres, above 0.
fn length(word: &str) -> Result<f64, String> {
    match word.parse() {
        Ok(length) if length > 0.0 && f64::is_finite(length) => Ok(length),
        _ => Err("it is to be a number above 0, in metres".to_owned()),
    }
}

/// Runs `urdd generate`.
pub fn run(arguments: &GenerateArguments) -> ExitCode {
    match generate(arguments) {
        Ok(status) => ExitCode::from(status),
        Err(message) => {
            output::error(&message);
            ExitCode::from(USAGE)
        }
    }
}

/// Gives the exit status.
fn generate(arguments: &GenerateArguments) -> Result<u8, String> {
    let signals = Signals::listen().map_err(|error| error.to_string())?;
    let (robots, xacro_arguments) = split(&arguments.robots);
    let settings = settings(arguments, xacro_arguments, &signals)?;
    let mut pool = rayon::ThreadPoolBuilder::new();
    if let Some(threads) = arguments.threads {
        pool = pool.num_threads(threads.into());
    }
    let pool = pool.build().map_err(|error| error.to_string())?;
    // A crash is caught and reported; the default hook would print besides.
    std::panic::set_hook(Box::new(|_| {}));
    let is_batch = batch::is_batch(&robots);
    if is_batch && robots.iter().any(|path| path.as_os_str() == STANDARD_INPUT) {
        return Err("`-` is one robot, and cannot be part of a batch".to_owned());
    }
    let printer = Printer::new(
        arguments.format,
        is_batch,
        std::io::stderr().is_terminal() && !output::is_dumb(),
    );
    let failed = if is_batch {
        let mut jobs =
            batch::jobs(&robots).map_err(|error| escape::line(&error.to_string()).into_owned())?;
        check_used(
            arguments,
            &settings,
            jobs.iter().map(|job| job.source.as_path()),
        )?;
        if let Some(shard) = arguments.shard {
            jobs = shard.of(jobs);
        }
        printer.begin(jobs.len());
        let failed = pool.install(|| batch::run(&jobs, &arguments.output, &settings, &printer));
        if signals.status().is_none() {
            printer.end(jobs.len(), failed);
        }
        failed
    } else {
        if arguments.shard.is_some() {
            return Err("--shard is for batches: give several robots, or a folder".to_owned());
        }
        let source = robots.into_iter().next();
        let source = source.ok_or("there is no robot; give a URDF or xacro file")?;
        check_used(arguments, &settings, [source.as_path()])?;
        one(source, &arguments.output, &settings, &pool, &printer)?
    };
    let _ = std::panic::take_hook();
    if let Some(status) = signals.status() {
        output::error("stopped by a signal; URDDs that were not done are as they were before");
        return Ok(status);
    }
    match printer.unprinted() {
        Some(message) => Err(message),
        None if failed > 0 => Ok(FAILED),
        None => Ok(0),
    }
}

/// Refuses arguments for xacro where no file is given to it: they would change nothing.
fn check_used<'a>(
    arguments: &GenerateArguments,
    settings: &Settings,
    sources: impl IntoIterator<Item = &'a Path>,
) -> Result<(), String> {
    let is_expanded =
        |path: &Path| arguments.xacro || path.extension().is_some_and(|ending| ending == "xacro");
    match settings.xacro.arguments.first() {
        Some(unused) if !sources.into_iter().any(is_expanded) => Err(format!(
            "`{}` is an argument for xacro, and there is no .xacro file; `--xacro` expands macros in .urdf files too",
            escape::line(unused)
        )),
        _ => Ok(()),
    }
}

/// Robots, and arguments for xacro.
fn split(words: &[PathBuf]) -> (Vec<PathBuf>, Vec<String>) {
    let (mut robots, mut arguments) = (Vec::new(), Vec::new());
    for word in words {
        let text = word.to_str().unwrap_or_default();
        let is_argument = text.split_once(":=").is_some_and(|(name, _)| {
            let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
            !name.is_empty() && name.chars().all(is_of_name)
        });
        match is_argument {
            true => arguments.push(text.to_owned()),
            false => robots.push(word.clone()),
        }
    }
    (robots, arguments)
}

/// A single robot, whose URDD is the output folder itself.
fn one(
    source: PathBuf,
    output: &Path,
    settings: &Settings,
    pool: &rayon::ThreadPool,
    printer: &Printer,
) -> Result<usize, String> {
    use crate::generate::batch::Observer;
    let piped = match source.as_os_str() == STANDARD_INPUT {
        true => Some(standard_input()?),
        false => None,
    };
    let job = Job {
        source,
        name: output.display().to_string(),
    };
    let progress = printer.begin_robot(&job);
    let outcome = pool.install(|| {
        batch::caught(&job.source, || match piped {
            Some(urdf) => {
                let shown = "standard input";
                generate_text(urdf, shown, Path::new("."), output, settings, &*progress)
            }
            None => crate::generate::generate(&job.source, output, settings, &*progress),
        })
    });
    drop(progress);
    printer.done(&job, &outcome);
    Ok(usize::from(outcome.is_err()))
}

/// All of standard input, and one byte more than a URDF may have at most.
fn standard_input() -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let input = std::io::stdin().lock();
    input
        .take(MAX_SOURCE_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| format!("standard input cannot be read: {error}"))?;
    Ok(bytes)
}

fn settings(
    arguments: &GenerateArguments,
    xacro_arguments: Vec<String>,
    signals: &Signals,
) -> Result<Settings, String> {
    let selection = match arguments.modules.is_empty() {
        true => Selection::all(),
        false => Selection::parse(arguments.modules.iter().map(String::as_str))
            .map_err(|error| format!("--modules: {}", escape::line(&error.to_string())))?,
    };
    let mut packages = Packages::from_environment(|name| std::env::var_os(name));
    for argument in &arguments.packages {
        packages
            .add(argument)
            .map_err(|error| format!("--package: {}", escape::line(&error.to_string())))?;
    }
    for folder in &arguments.allowed_folders {
        if !folder.is_dir() {
            let folder = folder.display().to_string();
            return Err(format!(
                "--allow-folder: {} is not a folder",
                escape::line(&folder)
            ));
        }
    }
    Ok(Settings {
        selection,
        packages,
        allowed_folders: arguments.allowed_folders.clone(),
        preferred_geometry: match arguments.geometry {
            Preferred::Visual => GeometryKind::Visual,
            Preferred::Collision => GeometryKind::Collision,
        },
        mesh_formats: MeshFormats {
            stl: arguments.mesh_formats.contains(&MeshFormat::Stl),
            obj: arguments.mesh_formats.contains(&MeshFormat::Obj),
        },
        pieces: Pieces {
            most: arguments.pieces,
            tolerance: arguments.piece_tolerance,
        },
        num_samples: arguments.samples,
        xacro: XacroSettings {
            expand_urdf: arguments.xacro,
            arguments: xacro_arguments,
            time_limit: Duration::from_secs(arguments.xacro_timeout.into()),
        },
        strict: arguments.strict,
        drop_edits: arguments.drop_edits,
        skipped_reasons: arguments.skip.as_ref().map(|skip| {
            let reasons = skip.iter().copied();
            reasons.map(SkippedReason::from).collect()
        }),
        force: arguments.force,
        cancellation: signals.cancellation(),
    })
}
