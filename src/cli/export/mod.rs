//! `urdd export`.

mod arguments;
mod files;
mod init;
mod mjcf;
mod package;

use std::path::Path;
use std::process::ExitCode;

use super::output;
use super::shapes;
pub use arguments::ExportArguments;
use arguments::Target;
use urdd_export::{Format, Note, Options, Setup, SphereBudget, export};
use urdd_format::escape;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_robot::Robot;

/// Runs `urdd export`.
pub fn run(arguments: &ExportArguments) -> ExitCode {
    output::printed(match arguments.format.format() {
        Some(format) => write(arguments, format),
        None => init::write(arguments),
    })
}

fn write(arguments: &ExportArguments, format: Format) -> Result<(), String> {
    let target = arguments.format;
    let output =
        (arguments.output.as_deref()).ok_or_else(|| "give the file to write with -o".to_owned())?;
    let to_standard_output = output.as_os_str() == "-";
    if to_standard_output && !target.is_alone() {
        return Err("this format writes other files beside its own: give a file with -o".to_owned());
    }
    check(arguments)?;
    let robot = shapes::open(&arguments.path)?;
    let options = options(arguments, &robot, output)?;
    let shown = escape::line(&arguments.path.display().to_string()).into_owned();
    let made = export(&robot, format, &options).map_err(|error| format!("{shown}: {error}"))?;
    for note in &made.notes {
        output::error(&format!("note: {note}"));
    }
    let is_disabled = |note: &Note| matches!(note, Note::Mixed { disabled: true, .. });
    if made.notes.iter().any(is_disabled) {
        output::error("note: --keep-pairs checks these pairs of links as a whole");
    }
    files::write(arguments, output, made)
}

/// An error if an option is not for the format.
fn check(arguments: &ExportArguments) -> Result<(), String> {
    let target = arguments.format;
    let is_of = |targets: &[Target]| targets.contains(&target);
    let wrong = [
        (
            arguments.update && !is_of(&[Target::Srdf, Target::Moveit]),
            "--update is for SRDF and MoveIt only; --force overwrites a file",
        ),
        (
            arguments.mjcf.is_given() && target != Target::Mjcf,
            "--actuators, --sensors and --scene are for MJCF only",
        ),
        (
            arguments.floating_base && !is_of(&[Target::Mjcf, Target::Sdf]),
            "--floating-base is for MJCF and SDF only",
        ),
        (arguments.config.is_some() && target != Target::Curobo, "--config is for cuRobo only"),
        (
            arguments.package.is_some() && !is_of(&[Target::Moveit, Target::Drake]),
            "--package is for MoveIt and Drake only",
        ),
    ];
    let wrong = wrong.into_iter().find(|(is_wrong, _)| *is_wrong);
    wrong.map_or(Ok(()), |(_, words)| Err(words.to_owned()))
}

fn options(arguments: &ExportArguments, robot: &Robot, output: &Path) -> Result<Options, String> {
    let reasons = arguments.reasons.as_ref();
    let setup = match &arguments.setup {
        Some(file) => Setup::read(file, robot).map(Some),
        None => Setup::beside(&arguments.path, robot),
    };
    let package = match (&arguments.package, arguments.format) {
        (None, Target::Moveit) => Some(package::of_folder(output)),
        (given, _) => given.clone(),
    };
    let stem = output.file_stem().map(|stem| stem.to_string_lossy());
    let mesh_folder = match (&package, arguments.format) {
        (Some(package), Target::Moveit) => format!("package://{package}/meshes"),
        _ => format!("{}_meshes", stem.unwrap_or_default()),
    };
    let robot_file = match &arguments.config {
        Some(None) => Some(package::urdf(robot)?),
        Some(given) => given.clone(),
        None => None,
    };
    Ok(Options {
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
        detail: arguments.visuals.unwrap_or_default(),
        mesh_folder,
        file: output.file_name().map(|name| name.to_string_lossy().into_owned()),
        package,
        robot_file,
        floating_base: arguments.floating_base,
        setup: setup.map_err(|error| error.to_string())?,
        mjcf: arguments.mjcf.options(),
    })
}
