//! `urdd export`.

mod arguments;
mod files;
mod init;
mod mjcf;

use std::process::ExitCode;

use super::inputs;
use super::output::{self, Failure};
pub use arguments::ExportArguments;
use arguments::Target;
use urdd_export::{Choices, Format, Note, Setup, SphereBudget, export};
use urdd_robot::Robot;

/// Runs `urdd export`.
pub fn run(arguments: &ExportArguments) -> ExitCode {
    let written = match arguments.format.format() {
        Some(format) => write(arguments, format),
        None => init::write(arguments),
    };
    output::ended(written.map(|()| 0))
}

fn write(arguments: &ExportArguments, format: Format) -> Result<(), Failure> {
    let target = arguments.format;
    let output = arguments.output.as_deref().ok_or("give the file to write with -o")?;
    let to_standard_output = output.as_os_str() == "-";
    if to_standard_output && !target.is_alone() {
        Err("this format writes other files beside its own: give a file with -o")?;
    }
    if arguments.update && !matches!(target, Target::Srdf | Target::Moveit) {
        Err("--update is for srdf and moveit only; --force overwrites a file")?;
    }
    let robot = inputs::open(&arguments.path)?;
    let options = choices(arguments, &robot)?.options(format).map_err(|misfit| {
        let option = match misfit.option {
            "robot_file" => "config".to_owned(),
            option => option.replace('_', "-"),
        };
        format!("--{option} is for {} only", misfit.formats())
    })?;
    let made = export(&robot, &options).map_err(output::about(&arguments.path))?;
    for note in &made.notes {
        output::error(&format!("note: {note}"));
    }
    let is_disabled = |note: &Note| matches!(note, Note::Mixed { disabled: true, .. });
    if made.notes.iter().any(is_disabled) {
        let how = if format == Format::Usd { "by piece" } else { "as a whole" };
        output::error(&format!("note: --keep-pairs checks these pairs of links {how}"));
    }
    files::write(arguments, output, made)
}

fn choices(arguments: &ExportArguments, robot: &Robot) -> Result<Choices, Failure> {
    let reasons = arguments.reasons.as_ref();
    let robot_file = match &arguments.config {
        Some(None) => Some(urdf_of(robot)?),
        Some(given) => given.clone(),
        None => None,
    };
    let mut choices = Choices {
        shapes: arguments.shapes,
        reasons: reasons.map(|skip| skip.iter().copied().map(Into::into).collect()),
        keep_pairs: arguments.keep_pairs,
        spheres: SphereBudget::new(arguments.spheres, arguments.total_spheres),
        cover: arguments.cover,
        samples: arguments.samples as usize,
        visuals: (!arguments.no_visuals).then(|| arguments.visuals.unwrap_or_default()),
        output: arguments.output.clone(),
        package: arguments.package.clone(),
        ros: arguments.ros,
        robot_file,
        floating_base: arguments.floating_base,
        merge_fixed: arguments.merge_fixed,
        root: arguments.root.clone(),
        fit: arguments.fit.map(Option::unwrap_or_default),
        setup: Setup::find(arguments.setup.as_deref(), &arguments.path, robot)?,
        ..Choices::default()
    };
    arguments.mjcf.choose(&mut choices);
    Ok(choices)
}

/// The name of the URDF from which a URDD was made.
fn urdf_of(robot: &Robot) -> Result<String, Failure> {
    let path = robot.source()?.map(|source| source.path);
    let name = path.as_deref().and_then(|path| path.rsplit('/').next());
    Ok(name.unwrap_or("robot.urdf").to_owned())
}
