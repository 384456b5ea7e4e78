//! The arguments that `urdd generate` and `urdd combine` share: how to generate a URDD.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, ValueEnum};

use super::generate_output::Format;
use super::signals::Signals;
use urdd_format::escape;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::meshes::GeometryKind;
use urdd_generate::train::Effort;
use urdd_generate::{MeshFormats, Packages, Pieces, Selection, Settings, XacroSettings};

/// How a URDD is made.
#[derive(Args)]
pub(super) struct MakingArguments {
    /// Modules to make besides the core class, or classes (core, geometry, shapes), separated by commas; what they are
    /// derived from is made too. Without it, all but self_collision_model, which takes some seconds to train.
    #[arg(long, value_name = "MODULES", value_delimiter = ',')]
    modules: Vec<String>,

    /// Where a ROS package is; may be given again.
    #[arg(long = "package", value_name = "NAME=PATH")]
    packages: Vec<String>,

    /// A folder besides those of the robot and its packages from which mesh files may be taken, and the parts of a recipe
    /// besides its own folder; may be given again.
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
    pub(super) threads: Option<u16>,

    /// Makes nothing of a robot of which a mesh is not found, or anything has to be assumed that changes it.
    #[arg(long)]
    strict: bool,

    /// Expands macros in .urdf files too, and the xacro files that a recipe names.
    #[arg(long)]
    pub(super) xacro: bool,

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
    pub(super) format: Format,
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

impl MakingArguments {
    /// A pool with the requested number of threads.
    pub(super) fn pool(&self) -> Result<rayon::ThreadPool, String> {
        let mut pool = rayon::ThreadPoolBuilder::new();
        if let Some(threads) = self.threads {
            pool = pool.num_threads(threads.into());
        }
        pool.build().map_err(|error| error.to_string())
    }

    pub(super) fn settings(
        &self,
        xacro_arguments: Vec<String>,
        signals: &Signals,
    ) -> Result<Settings, String> {
        let selection = match self.modules.is_empty() {
            true => Selection::all(),
            false => Selection::parse(self.modules.iter().map(String::as_str))
                .map_err(|error| format!("--modules: {}", escape::line(&error.to_string())))?,
        };
        let mut packages = Packages::from_environment(|name| std::env::var_os(name));
        for argument in &self.packages {
            packages
                .add(argument)
                .map_err(|error| format!("--package: {}", escape::line(&error.to_string())))?;
        }
        for folder in &self.allowed_folders {
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
            allowed_folders: self.allowed_folders.clone(),
            preferred_geometry: match self.geometry {
                Preferred::Visual => GeometryKind::Visual,
                Preferred::Collision => GeometryKind::Collision,
            },
            mesh_formats: MeshFormats {
                stl: self.mesh_formats.contains(&MeshFormat::Stl),
                obj: self.mesh_formats.contains(&MeshFormat::Obj),
            },
            pieces: Pieces {
                most: self.pieces,
                tolerance: self.piece_tolerance,
            },
            num_samples: self.samples,
            model_effort: Effort::default(),
            xacro: XacroSettings {
                expand_urdf: self.xacro,
                arguments: xacro_arguments,
                time_limit: Duration::from_secs(self.xacro_timeout.into()),
            },
            strict: self.strict,
            drop_edits: self.drop_edits,
            skipped_reasons: self.skip.as_ref().map(|skip| {
                let reasons = skip.iter().copied();
                reasons.map(SkippedReason::from).collect()
            }),
            force: self.force,
            donors: Vec::new(),
            cancellation: signals.cancellation(),
        })
    }
}
