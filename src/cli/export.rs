//! `urdd export`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::making::Skip;
use super::output;
use super::shapes::{self, Shapes};
use urdd_directory::regular;
use urdd_export::{Export, Format, Note, Options, SphereBudget, export, merge_srdf};
use urdd_format::escape;
use urdd_format::link_shapes_skips::SkippedReason;

/// Maximum size of an SRDF to update, in bytes.
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

    /// Checks a pair of links of which the URDD skips some pieces and checks others, in formats that know links only.
    /// Without it, such a pair is disabled. MJCF has each piece as the URDD has it, in either case.
    #[arg(long)]
    keep_pairs: bool,

    /// At most so many spheres for each link. Without it, 12 on average and at most 150 in all; with `--cover`, 8.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    spheres: Option<u16>,

    /// At most so many spheres for all links together, but at least one for each.
    #[arg(long, value_name = "N", conflicts_with = "spheres", value_parser = clap::value_parser!(u16).range(1..))]
    total_spheres: Option<u16>,

    /// Spheres hold all of each link. No collision is missed then, but often every configuration is in contact: the file
    /// says how often. Without it, spheres are fitted such that they answer as the shapes do.
    #[arg(long)]
    cover: bool,

    /// In how many sampled configurations spheres are measured, or fewer where that is much work.
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(100..=1_000_000))]
    samples: u32,

    /// Leaves out what links look like: the file has collision geometry only.
    #[arg(long)]
    no_visuals: bool,

    /// Replaces the pairs of links in an SRDF that is there, but those that a person wrote (their reason is `User`, or a
    /// text), and leaves everything else in it as it is.
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
    output::printed(write(arguments))
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
        keep_pairs: arguments.keep_pairs,
        spheres: match (arguments.total_spheres, arguments.spheres) {
            (Some(count), _) => SphereBudget::Total(count.into()),
            (None, Some(count)) => SphereBudget::PerLink(count.into()),
            (None, None) => SphereBudget::Auto,
        },
        cover: arguments.cover,
        samples: arguments.samples as usize,
        visuals: !arguments.no_visuals,
        mesh_folder: folder,
    };
    let shown = escape::line(&arguments.path.display().to_string()).into_owned();
    let mut made = export(&robot, arguments.format.format(), &options)
        .map_err(|error| format!("{shown}: {error}"))?;
    for note in &made.notes {
        output::error(&format!("note: {note}"));
    }
    let is_disabled = |note: &Note| matches!(note, Note::Mixed { disabled: true, .. });
    if made.notes.iter().any(is_disabled) {
        output::error("note: --keep-pairs checks these pairs of links as a whole");
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
    // The file that references the others is last.
    let files = made.files.iter();
    let files = files.map(|(path, bytes)| (place.join(path), bytes.as_slice()));
    let own = (output.clone(), made.text.as_bytes());
    let files: Vec<(PathBuf, &[u8])> = files.chain([own]).collect();
    output::write_files(&files)
}

/// The existing SRDF, merged with the new pairs.
fn merged(file: &Path, new: &str) -> Result<String, String> {
    let shown = escape::line(&file.display().to_string()).into_owned();
    let failed = |error: &dyn std::fmt::Display| format!("{shown}: {error}");
    let old = regular::read(file, MAX_SRDF_BYTES).map_err(|error| {
        failed(&format!(
            "cannot be read: {error}; leave --update out to write a new file"
        ))
    })?;
    let old = String::from_utf8(old).map_err(|_| failed(&"it is not UTF-8"))?;
    let merged = merge_srdf(&old, new).map_err(|error| failed(&error))?;
    let pairs = |count: usize| match count {
        1 => "1 pair of links".to_owned(),
        _ => format!("{count} pairs of links"),
    };
    if merged.kept > 0 {
        let pairs = pairs(merged.kept);
        output::error(&format!(
            "note: {pairs} kept that a person disabled: their reason is none of Adjacent, Always, Default, Never"
        ));
    }
    if merged.enabled > 0 {
        let pairs = pairs(merged.enabled);
        output::error(&format!("note: {pairs} not disabled that a person enabled"));
    }
    Ok(merged.text)
}

/// An error if a file exists with different content.
fn refuse_existing(arguments: &ExportArguments, made: &Export, place: &Path) -> Result<(), String> {
    let own = (!arguments.update).then(|| (arguments.output.clone(), made.text.as_bytes()));
    let meshes = made.files.iter();
    let meshes = meshes.map(|(path, bytes)| (place.join(path), bytes.as_slice()));
    let differs = |(file, bytes): &(PathBuf, &[u8])| match fs::metadata(file) {
        Ok(there) if there.is_file() => {
            let read = regular::read(file, bytes.len() as u64);
            !read.is_ok_and(|there| there == *bytes)
        }
        // Writing to devices and pipes is allowed.
        Ok(there) => there.is_dir(),
        Err(_) => fs::symlink_metadata(file).is_ok(),
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
