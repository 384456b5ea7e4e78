//! `urdd info`, and what it says of the xacro files of a package.

mod contents;
mod modules;
mod sampled;

use std::fmt::{self, Display, Write};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde::Serialize;

use self::contents::Info;
use self::sampled::{Statics, StaticsArguments};
use super::arguments::around;
use super::inputs;
use super::output::{self, Failure, about, shown};
use super::watch::Watch;
use urdd_directory::discover::{Found, discover};
use urdd_directory::file_type::FileType;
use urdd_export::joint_orders;
use urdd_format::escape;
use urdd_source::arguments::{XacroArgument, arguments};
use urdd_source::robots::{BatchError, jobs};
use urdd_validate::report;

/// Arguments of `urdd info`.
#[derive(Args)]
pub struct InfoArguments {
    /// URDDs, or folders with URDDs at any depth; xacro files, or folders of them such as a ROS package, for the arguments
    /// that they take.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,

    /// Output format.
    #[arg(long, value_enum, default_value_t = InfoFormat::Human)]
    format: InfoFormat,

    /// Also list the joints that move, and the actuators, in the order of each program that loads an export.
    #[arg(long)]
    order: bool,

    #[command(flatten)]
    statics: StaticsArguments,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum InfoFormat {
    /// Text for people.
    Human,
    /// JSON: a list with an object per URDD.
    Json,
}

/// Runs `urdd info`.
pub fn run(arguments: &InfoArguments, watch: &Watch) -> Result<u8, Failure> {
    let first = arguments.paths.first().map_or(Path::new(""), PathBuf::as_path);
    watch.run_one(first, None, |_| {
        output::print(&text(arguments)?)?;
        Ok(0)
    })
}

/// What it prints.
fn text(arguments: &InfoArguments) -> Result<String, Failure> {
    let (mut infos, mut files) = (Vec::new(), Vec::new());
    for path in &arguments.paths {
        let found = match discover(path) {
            Err(error) => match robot_files(path) {
                Ok(more) if !more.is_empty() => {
                    files.extend(more);
                    continue;
                }
                _ => Err(inputs::advice(&error))?,
            },
            Ok(found) => found,
        };
        for Found { path, name, closed } in found {
            let info = closed.map_or_else(|| Info::read(&path, &name), Err);
            let about = |error: &dyn Display| format!("{}: {error}", escape::line(&name));
            let mut info = info.map_err(|error| about(&error))?;
            if info.robot_name.is_none() && info.modules.is_empty() {
                Err(about(&"nothing in it can be read; `urdd validate` says why"))?;
            }
            let statics = Statics::of(&path, &arguments.statics);
            info.statics = statics.map_err(|error| about(&error))?;
            if arguments.order {
                let robot = inputs::open(&path).map_err(|error| about(&error))?;
                info.order = Some(joint_orders(&robot).map_err(|error| about(&error))?);
            }
            infos.push(info);
        }
    }
    if arguments.format == InfoFormat::Json {
        let infos = infos.iter().map(serde_json::to_value);
        let all: Result<Vec<_>, _> = infos.chain(files.iter().map(serde_json::to_value)).collect();
        return Ok(report::json(&all?)?);
    }
    let mut text = String::new();
    for file in &files {
        write_robot_file(file, &mut text)?;
        text.push('\n');
    }
    for info in &infos {
        contents::write(info, &mut text)?;
        text.push('\n');
    }
    Ok(text)
}

#[derive(Serialize)]
struct RobotFile {
    /// The file, from the current folder.
    source: String,
    arguments: Vec<ArgumentInfo>,
}

#[derive(Serialize)]
struct ArgumentInfo {
    name: String,
    default: Option<String>,
    values: Vec<String>,
    is_needed: bool,
}

/// The xacro files of robots at or below a path. Nothing is run.
fn robot_files(path: &Path) -> Result<Vec<RobotFile>, BatchError> {
    let settings = around();
    let of = |source: PathBuf| {
        let found = arguments(&source, &settings);
        let found = found.inspect_err(|error| output::error(&about(&source)(error)));
        let info = |XacroArgument { name, default, values, is_needed, .. }| ArgumentInfo {
            name,
            default,
            values,
            is_needed,
        };
        let arguments = found.unwrap_or_default().into_iter().map(info).collect();
        RobotFile { source: source.to_string_lossy().replace('\\', "/"), arguments }
    };
    let mut jobs = jobs(&[path.to_owned()], &settings)?;
    jobs.retain(|job| FileType::Xacro.is_of(&job.source));
    Ok(jobs.into_iter().map(|job| of(job.source)).collect())
}

/// Writes a file, with a line for each argument.
fn write_robot_file(file: &RobotFile, out: &mut String) -> fmt::Result {
    writeln!(out, "{}", shown(Path::new(&file.source)))?;
    if file.arguments.is_empty() {
        writeln!(out, "  no arguments")?;
    }
    for argument in &file.arguments {
        write!(out, "  {}", escape::line(&argument.name))?;
        if let Some(default) = &argument.default {
            write!(out, " = {}", escape::quoted(default))?;
        }
        if argument.is_needed {
            write!(out, ", needs a value")?;
        }
        if !argument.values.is_empty() {
            write!(out, ": {}", escape::line(&argument.values.join(", ")))?;
        }
        writeln!(out)?;
    }
    Ok(())
}
