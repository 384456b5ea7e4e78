//! `urdd generate`, and the arguments that it shares with `urdd combine`: how to generate a URDD.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::{Args, ValueEnum};

use super::arguments::{
    LoopsArguments, PackageArguments, Preferred, RobotArguments, XacroArguments, split, value_of,
};
use super::generate_output::{Printer, ResultFormat};
use super::output::{self, Failure, Signals, one_line};
use urdd_directory::file_type::FileType;
use urdd_export::REASONS;
use urdd_format::escape;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_generate::batch::{self, Observer, Shard};
use urdd_generate::{
    GenerateError, Generated, MAX_SOURCE_BYTES, MeshFormats, PIECE_TOLERANCE, PIECES, Pieces,
    Progress, SAMPLES, Selection, Settings, generate_text,
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
    output::stoppable(Some(stopped), |signals| {
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
    let is_piped = job.source.as_os_str() == STANDARD_INPUT;
    let piped = is_piped.then(standard_input).transpose()?;
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
    let read = std::io::stdin().lock().take(MAX_SOURCE_BYTES + 1).read_to_end(&mut bytes);
    read.map_err(|error| format!("standard input cannot be read: {error}"))?;
    Ok(bytes)
}

/// How a URDD is made.
#[derive(Args)]
pub(super) struct MakingArguments {
    /// Modules or classes (core, geometry, shapes) to generate besides the core class, separated by commas. The modules
    /// that they depend on are added. Default: all except self_collision_model, which takes some seconds to train.
    #[arg(long, value_name = "MODULES", value_delimiter = ',')]
    modules: Vec<String>,

    #[command(flatten)]
    packages: PackageArguments,

    #[command(flatten)]
    named_loops: LoopsArguments,

    /// Elements that the geometry of links is taken from. A link without any of them uses the other kind.
    #[arg(long, value_enum, default_value_t = Preferred::Visual)]
    geometry: Preferred,

    /// File formats of each plain mesh, hull and piece, separated by commas. The .glb is always written; `glb` alone
    /// makes the URDD about half as large.
    #[arg(
        long,
        value_enum,
        value_name = "FORMATS",
        value_delimiter = ',',
        default_value = "glb,stl,obj"
    )]
    mesh_formats: Vec<MeshFormat>,

    /// Maximum number of convex pieces per link.
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = |word: &str| PIECES.parse::<u8>(word))]
    pieces: u8,

    /// Stops adding pieces to a link once the estimated mean distance from their outside to its surface is at most this,
    /// in metres. By default, stops once another piece would save too little in proportion to the link's size.
    #[arg(long, value_name = "METRES", value_parser = |word: &str| PIECE_TOLERANCE.parse::<f64>(word))]
    piece_tolerance: Option<f64>,

    /// Number of sampled configurations for the distance statistics, at most 100,000.
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = |word: &str| SAMPLES.parse::<u32>(word))]
    samples: u32,

    /// Reasons for which collision checks skip pairs of shapes, separated by commas. Default: those of the URDD that is
    /// replaced; for a new one same-link, always, adjacent and default. `never` is based on samples alone.
    #[arg(long, value_parser = value_of::<SkippedReason>(REASONS), value_name = "REASONS", value_delimiter = ',')]
    skip: Option<Vec<SkippedReason>>,

    /// Named configuration of the URDD that is replaced in which pairs of links that touch are skipped, in place of the
    /// default configuration. `default` is that one again.
    #[arg(long, value_name = "NAME")]
    reference: Option<String>,

    /// Number of threads; default: one per processor. The URDD is the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) threads: Option<u16>,

    /// Refuses a robot if a mesh is not found, or if an assumption would change the robot.
    #[arg(long)]
    strict: bool,

    #[command(flatten)]
    pub(super) xacro: XacroArguments,

    /// Drops the edits of skips and the named configurations in the URDD that is replaced. By default, a new run keeps them,
    /// or stops if it cannot.
    #[arg(long)]
    drop_edits: bool,

    /// Writes even into a folder that contains something other than a URDD of this program. Files with other names stay.
    #[arg(long)]
    force: bool,

    /// Format of the results on standard output.
    #[arg(long, value_enum, default_value_t = ResultFormat::Human)]
    pub(super) format: ResultFormat,
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

impl MakingArguments {
    pub(super) fn pool(&self) -> Result<rayon::ThreadPool, Failure> {
        let mut pool = rayon::ThreadPoolBuilder::new();
        if let Some(threads) = self.threads {
            pool = pool.num_threads(threads.into());
        }
        Ok(pool.build()?)
    }

    pub(super) fn settings(
        &self,
        xacro_arguments: Vec<String>,
        signals: &Signals,
    ) -> Result<Settings, Failure> {
        let selection = match self.modules.is_empty() {
            true => Selection::all(),
            false => Selection::parse(self.modules.iter().map(String::as_str))
                .map_err(|error| format!("--modules: {}", one_line(error)))?,
        };
        Ok(Settings {
            selection,
            preferred_geometry: self.geometry.into(),
            mesh_formats: MeshFormats {
                stl: self.mesh_formats.contains(&MeshFormat::Stl),
                obj: self.mesh_formats.contains(&MeshFormat::Obj),
            },
            pieces: Pieces { most: self.pieces, tolerance: self.piece_tolerance },
            num_samples: self.samples,
            source: urdd_source::Settings {
                xacro: self.xacro.settings(xacro_arguments),
                loops: self.named_loops.loops.clone(),
                cancellation: signals.cancellation(),
                ..self.packages.settings()?
            },
            strict: self.strict,
            drop_edits: self.drop_edits,
            skipped_reasons: self.skip.clone(),
            reference: self.reference.clone(),
            force: self.force,
            ..Settings::default()
        })
    }
}
