//! `urdd export`.

mod arguments;
mod files;
mod init;
mod mjcf;

use std::process::ExitCode;

use super::output;
use super::shapes;
pub use arguments::ExportArguments;
use arguments::Target;
use urdd_export::{Choices, Format, Note, Setup, SphereBudget, export};
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
    if arguments.update && !matches!(target, Target::Srdf | Target::Moveit) {
        return Err("--update is for srdf and moveit only; --force overwrites a file".to_owned());
    }
    let robot = shapes::open(&arguments.path)?;
    let options = choices(arguments, &robot)?.options(format).map_err(|misfit| {
        let option = match misfit.option {
            "robot_file" => "config".to_owned(),
            option => option.replace('_', "-"),
        };
        format!("--{option} is for {} only", misfit.formats())
    })?;
    let shown = escape::line(&arguments.path.display().to_string()).into_owned();
    let made = export(&robot, &options).map_err(|error| format!("{shown}: {error}"))?;
    for note in &made.notes {
        output::error(&format!("note: {note}"));
    }
    let is_disabled = |note: &Note| matches!(note, Note::Mixed { disabled: true, .. });
    if made.notes.iter().any(is_disabled) {
        output::error("note: --keep-pairs checks these pairs of links as a whole");
    }
    files::write(arguments, output, made)
}

fn choices(arguments: &ExportArguments, robot: &Robot) -> Result<Choices, String> {
    let reasons = arguments.reasons.as_ref();
    let setup = Setup::find(arguments.setup.as_deref(), &arguments.path, robot);
    let robot_file = match &arguments.config {
        Some(None) => Some(urdf_of(robot)?),
        Some(given) => given.clone(),
        None => None,
    };
    let mut choices = Choices {
        shapes: arguments.shapes.kind(),
        reasons: reasons.map(|skip| skip.iter().copied().map(SkippedReason::from).collect()),
        keep_pairs: arguments.keep_pairs,
        spheres: SphereBudget::new(arguments.spheres, arguments.total_spheres),
        cover: arguments.cover,
        samples: arguments.samples as usize,
        visuals: (!arguments.no_visuals).then(|| arguments.visuals.unwrap_or_default()),
        output: arguments.output.clone(),
        package: arguments.package.clone(),
        robot_file,
        floating_base: arguments.floating_base,
        setup: setup.map_err(|error| error.to_string())?,
        ..Choices::default()
    };
    arguments.mjcf.choose(&mut choices);
    Ok(choices)
}

/// The name of the URDF from which a URDD was made.
fn urdf_of(robot: &Robot) -> Result<String, String> {
    let source = robot.source().map_err(|error| error.to_string())?;
    let path = source.map(|source| source.path);
    let name = path.as_deref().and_then(|path| path.rsplit('/').next());
    Ok(name.unwrap_or("robot.urdf").to_owned())
}
