//! `urdd export`.

mod arguments;

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::inputs;
use super::output::{self, Failure, about, shown};
pub use arguments::ExportArguments;
use arguments::name_of;
use urdd_directory::outputs::{self, Output, Target as Place};
use urdd_export::{Choices, Export, Format, Note, Setup, export};
use urdd_format::readable::counted;
use urdd_robot::Robot;
use urdd_srdf::merge_srdf;

/// Runs `urdd export`.
pub fn run(arguments: &ExportArguments) -> Result<u8, Failure> {
    match arguments.format.0 {
        Some(format) => write_robot(arguments, format)?,
        None => write_setup(arguments)?,
    }
    Ok(0)
}

fn write_robot(arguments: &ExportArguments, format: Format) -> Result<(), Failure> {
    let output = arguments.output.as_deref().ok_or("give the file to write with -o")?;
    let is_alone = matches!(format, Format::Srdf | Format::Curobo | Format::Foam);
    if output.as_os_str() == "-" && !is_alone {
        Err("this format writes other files beside its own: give a file with -o")?;
    }
    if arguments.update && !matches!(format, Format::Srdf | Format::Moveit) {
        Err("--update is for srdf and moveit only; --force overwrites a file")?;
    }
    let robot = inputs::open(&arguments.path)?;
    let options = choices(arguments, &robot)?.options(format).map_err(|misfit| {
        format!("--{} is for {} only", name_of(misfit.option), misfit.formats())
    })?;
    let made = export(&robot, &options).map_err(about(&arguments.path))?;
    for note in &made.notes {
        output::error(&format!("note: {note}"));
    }
    let is_disabled = |note: &Note| matches!(note, Note::Mixed { disabled: true, .. });
    if made.notes.iter().any(is_disabled) {
        let how = if format == Format::Usd { "by piece" } else { "as a whole" };
        output::error(&format!("note: --keep-pairs checks these pairs of links {how}"));
    }
    write(arguments, output, made)
}

fn choices(arguments: &ExportArguments, robot: &Robot) -> Result<Choices, Failure> {
    let mut choices = Choices {
        output: arguments.output.clone(),
        setup: Setup::find(arguments.setup.as_deref(), &arguments.path, robot)?,
        ..Choices::default()
    };
    for (choice, value) in &arguments.chosen.0 {
        let set = match (choice.name, value) {
            ("robot_file", Value::Bool(true)) => choice.set(&mut choices, &urdf_of(robot)?.into()),
            _ => choice.set(&mut choices, value),
        };
        set.map_err(|error| error.to_string())?;
    }
    Ok(choices)
}

/// The name of the URDF from which a URDD was made.
fn urdf_of(robot: &Robot) -> Result<String, Failure> {
    let path = robot.source()?.map(|source| source.path);
    let name = path.as_deref().and_then(|path| path.rsplit('/').next());
    Ok(name.unwrap_or("robot.urdf").to_owned())
}

/// The existing SRDF, merged with the new pairs.
fn merged(file: &Path, new: &str) -> Result<String, Failure> {
    let help = |error| format!("{error}; omit --update to write a new file");
    let merged = merge_srdf(&inputs::srdf(file).map_err(help)?, new).map_err(about(file))?;
    let pairs = |count| format!("{} of links", counted(count, "pair"));
    if merged.kept > 0 {
        let pairs = pairs(merged.kept);
        output::error(&format!(
            "note: kept {pairs} that a person disabled: their reason is not Adjacent, Always, Default or Never"
        ));
    }
    if merged.enabled > 0 {
        let pairs = pairs(merged.enabled);
        output::error(&format!("note: did not disable {pairs} that a person enabled"));
    }
    Ok(merged.text)
}

/// Writes the text, the other files and the report. What exists is overwritten on request only.
fn write(arguments: &ExportArguments, output: &Path, mut made: Export) -> Result<(), Failure> {
    let report = arguments.report.as_deref().map(|file| (file, made.report.as_bytes()));
    let force = arguments.force;
    if output.as_os_str() == "-" {
        if let Some((file, _)) = report {
            output::write_files(Place::File(file), Vec::new(), report, force, "")?;
        }
        return Ok(output::print_raw(&made.text)?);
    }
    let (own, target) = match &made.path {
        Some(path) => (PathBuf::from(path), Place::Folder(output)),
        None => (outputs::name_of(output).into(), Place::File(output)),
    };
    let place = target.folder().join(&own);
    let is_merged = arguments.update && (made.path.is_none() || place.exists());
    if is_merged {
        made.text = merged(&place, &made.text)?;
    }
    // The file that references the others is last.
    let mut files: Vec<Output> = (made.files.iter())
        .map(|(path, bytes)| Output { path: path.into(), bytes, replaces: force })
        .collect();
    if arguments.update {
        files.retain(|file| {
            let place = target.folder().join(&file.path);
            let stays = outputs::is_other(&place, file.bytes);
            if stays {
                output::error(&format!("note: {} stays as it is", shown(&place)));
            }
            !stays
        });
    }
    files.push(Output { path: own, bytes: made.text.as_bytes(), replaces: force || is_merged });
    let also = match arguments.format.0 {
        Some(Format::Srdf) => "; --update replaces the pairs of links in it",
        Some(Format::Moveit) => {
            "; --update replaces the pairs of links in the SRDF, and leaves other files as they are"
        }
        _ => "",
    };
    Ok(output::write_files(target, files, report, force, also)?)
}

/// Writes `NAME.export.toml`, or another file. One that exists is a person's: it stays.
fn write_setup(arguments: &ExportArguments) -> Result<(), Failure> {
    let path = &arguments.path;
    let robot = inputs::open(path)?;
    let setup = Setup::guess(&robot).map_err(about(path))?;
    let text = setup.to_toml(&robot).map_err(about(path))?;
    let file = arguments.output.clone().unwrap_or_else(|| Setup::path(path));
    if file.as_os_str() == "-" {
        return Ok(output::print_raw(&text)?);
    }
    if file.symlink_metadata().is_ok() && !arguments.force {
        Err(format!(
            "{} already exists and was left as it is: `-o -` prints the guesses, --force overwrites it",
            shown(&file)
        ))?;
    }
    output::write_alone(&file, text.as_bytes(), arguments.force)?;
    let file = shown(&file);
    let text = format!("{file}: written; check the lines that begin with `# Guess`\n");
    Ok(output::print(&text)?)
}
