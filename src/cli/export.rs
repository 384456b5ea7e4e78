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
    after_help = "Meshes are written to a folder beside the file: the file's name without its extension, followed by `_meshes`.\n\n\
    Exit status: 0 written; 2 nothing was written."
)]
pub struct ExportArguments {
    /// The format.
    #[arg(value_enum)]
    format: Target,

    /// A URDD: a folder or a zip archive.
    #[arg(value_name = "URDD")]
    path: PathBuf,

    /// The file to write; `-` prints a format that has no mesh files.
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,

    /// Shapes that represent the links, in the collision geometry and in the disabled pairs.
    #[arg(long, value_enum, default_value_t = Shapes::Pieces)]
    shapes: Shapes,

    /// Reasons for which pairs of links are disabled, separated by commas. Default: those of the URDD. A person's edits
    /// apply in either case.
    #[arg(long, value_enum, value_name = "REASONS", value_delimiter = ',')]
    reasons: Option<Vec<Skip>>,

    /// Checks a pair of links if the URDD skips some pairs of their pieces and checks others. By default, such a pair is
    /// disabled. Applies to formats that list pairs of links; MJCF always follows the URDD for each piece.
    #[arg(long)]
    keep_pairs: bool,

    /// Maximum number of spheres per link. Default: 12 on average and at most 150 in total; with `--cover`, 8.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    spheres: Option<u16>,

    /// Maximum number of spheres for all links together; each link has at least one.
    #[arg(long, value_name = "N", conflicts_with = "spheres", value_parser = clap::value_parser!(u16).range(1..))]
    total_spheres: Option<u16>,

    /// Makes the spheres enclose each link completely. No collision is missed then, but often every configuration is in
    /// contact; the file states how often. By default, spheres are fitted to give the same answers as the shapes.
    #[arg(long)]
    cover: bool,

    /// Number of sampled configurations in which spheres are measured; fewer where that would take long.
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(100..=1_000_000))]
    samples: u32,

    /// Leaves out visual geometry.
    #[arg(long)]
    no_visuals: bool,

    /// Replaces the pairs of links in an existing SRDF, except those that a person wrote (their reason is `User` or free
    /// text). Everything else in the file is unchanged.
    #[arg(long, conflicts_with = "force")]
    update: bool,

    /// Overwrites existing files.
    #[arg(long)]
    force: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Target {
    /// Pairs of links that need no check, for MoveIt.
    Srdf,
    /// URDF of the robot, with the URDD's shapes as collision geometry.
    Urdf,
    /// The same for Drake, with collision filter groups.
    Drake,
    /// For MuJoCo: bodies, joints, shapes, excluded pairs.
    Mjcf,
    /// Spheres and ignored pairs per link, for cuRobo.
    Curobo,
    /// Spheres per link, in Foam's format.
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
        return Err("this format writes mesh files beside its own: give a file with -o".to_owned());
    }
    if arguments.update && arguments.format != Target::Srdf {
        return Err("--update is for SRDF only; --force overwrites a file".to_owned());
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
            "cannot be read: {error}; omit --update to write a new file"
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
            "note: kept {pairs} that a person disabled: their reason is not Adjacent, Always, Default or Never"
        ));
    }
    if merged.enabled > 0 {
        let pairs = pairs(merged.enabled);
        output::error(&format!(
            "note: did not disable {pairs} that a person enabled"
        ));
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
        "{} already exists: --force overwrites it{also}",
        escape::line(&there.display().to_string())
    ))
}
