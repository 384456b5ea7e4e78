//! The arguments that `urdd generate` and `urdd combine` share: how to generate a URDD.

use clap::{Args, ValueEnum};

use super::generate_output::ResultFormat;
use super::output::{Failure, one_line};
use super::signals::Signals;
use super::sources::{LoopsArguments, PackageArguments, XacroArguments};
use super::words::{Preferred, value_of};
use urdd_export::REASONS;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_generate::{
    Effort, MeshFormats, PIECE_TOLERANCE, PIECES, Pieces, SAMPLES, Selection, Settings,
};

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
    /// A pool with the requested number of threads.
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
            model_effort: Effort::default(),
            source: urdd_source::Settings {
                xacro: self.xacro.settings(xacro_arguments),
                loops: self.named_loops.loops.clone(),
                ..self.packages.settings()?
            },
            strict: self.strict,
            drop_edits: self.drop_edits,
            skipped_reasons: self.skip.clone(),
            reference: self.reference.clone(),
            force: self.force,
            cancellation: signals.cancellation(),
            ..Settings::default()
        })
    }
}
