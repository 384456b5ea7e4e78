//! `urdd export`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::making::Skip;
use super::output;
use super::shapes::{self, Shapes};
use crate::export::{Export, Format, Options, SphereBudget, export, merge_srdf};
use crate::format::escape;
use crate::format::link_shapes_skips::SkippedReason;

/// Largest SRDF that is brought up to date, bytes.
const MAX_SRDF_BYTES: u64 = 16 << 20;

/// Arguments of `urdd export`.
#[derive(Args)]
#[command(
    after_help = "Meshes go into a folder beside the file, named as it is with `_meshes` after it.\n\n\
    Exit status: 0 written; 2 nothing was written."
)]
pub struct ExportArguments {
    /// The format.
    #[arg(value_enum)]
    format: Target,

    /// A URDD: a folder or a zip archive.
    #[arg(value_name = "URDD")]
    path: PathBuf,

    /// The file to write; `-` prints a format without meshes.
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,

    /// Which shapes stand for the links: as collision geometry, and for which pairs are disabled.
    #[arg(long, value_enum, default_value_t = Shapes::Pieces)]
    shapes: Shapes,

    /// For which reasons pairs of links are disabled, separated by commas. Without it, those of the URDD. A person's
    /// edits hold in either case.
    #[arg(long, value_enum, value_name = "REASONS", value_delimiter = ',')]
    reasons: Option<Vec<Skip>>,

    /// At most so many spheres for each link.
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u16).range(1..=1000))]
    spheres: u16,

    /// At most so many spheres for all links together, but at least one for each.
    #[arg(long, value_name = "N", conflicts_with = "spheres", value_parser = clap::value_parser!(u16).range(1..))]
    total_spheres: Option<u16>,

    /// Leaves out what links look like: the file has collision geometry only.
    #[arg(long)]
    no_visuals: bool,

    /// Replaces the pairs of links in an SRDF that is there, and leaves everything else in it as it is.
    #[arg(long, conflicts_with = "force")]
    update: bool,

    /// Writes over files that are there.
    #[arg(long)]
    force: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Target {
    /// Pairs of links that need no check, for MoveIt.
    Srdf,
    /// The robot with our shapes as collision geometry.
    Urdf,
    /// The same for Drake, with collision filter groups.
    Drake,
    /// For MuJoCo: bodies, joints, shapes, excluded pairs.
    Mjcf,
    /// Spheres and ignored pairs by link, for cuRobo.
    Curobo,
    /// Spheres by link, as Foam writes them.
    Foam,
}

impl Target {
    fn format(self) -> Format {
        match self {
            Target::Srdf => Format::Srdf,
            Target::Urdf => Format::Urdf,
            Target::Drake => Format::Drake,
            Target::Mjcf => Format::Mjcf,
            Target::Curobo => Format::Curobo,
            Target::Foam => Format::Foam,
        }
    }

    fn has_meshes(self) -> bool {
        matches!(self, Target::Urdf | Target::Drake | Target::Mjcf)
    }
}

/// Runs `urdd export`.
pub fn run(arguments: &ExportArguments) -> ExitCode {
    super::printed(write(arguments))
}

fn write(arguments: &ExportArguments) -> Result<(), String> {
    let output = &arguments.output;
    let to_standard_output = output.as_os_str() == "-";
    if to_standard_output && arguments.format.has_meshes() {
        return Err("this format has mesh files beside it: give a file with -o".to_owned());
    }
    if arguments.update && arguments.format != Target::Srdf {
        return Err("--update is for SRDF only; --force writes over a file".to_owned());
    }
    let robot = shapes::open(&arguments.path)?;
    let stem = output.file_stem().map(|stem| stem.to_string_lossy());
    let folder = format!("{}_meshes", stem.unwrap_or_default());
    let reasons = arguments.reasons.as_ref();
    let options = Options {
        shapes: arguments.shapes.kind(),
        reasons: reasons.map(|skip| skip.iter().copied().map(SkippedReason::from).collect()),
        spheres: match arguments.total_spheres {
            Some(count) => SphereBudget::Total(count.into()),
            None => SphereBudget::PerLink(arguments.spheres.into()),
        },
        visuals: !arguments.no_visuals,
        mesh_folder: folder,
    };
    let shown = escape::line(&arguments.path.display().to_string()).into_owned();
    let mut made = export(&robot, arguments.format.format(), &options)
        .map_err(|error| format!("{shown}: {error}"))?;
    for note in &made.notes {
        output::error(&format!("note: {note}"));
    }
    if to_standard_output {
        return output::print_raw(&made.text);
    }
    if arguments.update {
        made.text = merged(output, &made.text)?;
    }
    let place = output.parent().unwrap_or(Path::new(""));
    if !arguments.force {
        refuse_existing(arguments, &made, place)?;
    }
    for (path, bytes) in &made.files {
        let file = place.join(path);
        if let Some(folder) = file.parent() {
            fs::create_dir_all(folder).map_err(|error| {
                let folder = folder.display().to_string();
                format!("{}: cannot be made: {error}", escape::line(&folder))
            })?;
        }
        output::write_bytes(&file, bytes)?;
    }
    output::write_file(output, &made.text)
}

/// The SRDF that is there, with other pairs.
fn merged(file: &Path, new: &str) -> Result<String, String> {
    let shown = escape::line(&file.display().to_string()).into_owned();
    let size = fs::metadata(file).map(|metadata| metadata.len());
    if size.as_ref().is_ok_and(|size| *size > MAX_SRDF_BYTES) {
        return Err(format!("{shown}: larger than {MAX_SRDF_BYTES} bytes"));
    }
    let old = fs::read_to_string(file).map_err(|error| {
        format!("{shown}: cannot be read: {error}; leave --update out to write a new file")
    })?;
    merge_srdf(&old, new).map_err(|error| format!("{shown}: {error}"))
}

/// An error where a file is there that says something else.
fn refuse_existing(arguments: &ExportArguments, made: &Export, place: &Path) -> Result<(), String> {
    let own = (!arguments.update).then(|| (arguments.output.clone(), made.text.as_bytes()));
    let meshes = made.files.iter();
    let meshes = meshes.map(|(path, bytes)| (place.join(path), bytes.as_slice()));
    let differs = |(file, bytes): &(PathBuf, &[u8])| {
        let size = fs::symlink_metadata(file).map(|metadata| metadata.len());
        size.is_ok_and(|size| size != bytes.len() as u64)
            || fs::read(file).is_ok_and(|there| there != *bytes)
    };
    let Some((there, _)) = own.into_iter().chain(meshes).find(differs) else {
        return Ok(());
    };
    let also = match arguments.format {
        Target::Srdf => "; --update replaces the pairs of links in it",
        _ => "",
    };
    Err(format!(
        "{} is there already: --force writes over it{also}",
        escape::line(&there.display().to_string())
    ))
}
