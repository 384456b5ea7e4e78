//! `urdd info`.

mod contents;
mod loops;
mod parts;
mod robots;
mod skipped;
mod spheres;
mod statics;

use std::fmt::Display;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::inputs;
use super::output::Failure;
use contents::Info;
use robots::robot_files;
use statics::{Statics, StaticsArguments};
use urdd_directory::discover::{Found, discover};
use urdd_export::joint_orders;
use urdd_format::escape;
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

/// Runs `urdd info`. Returns what to print.
pub fn run(arguments: &InfoArguments) -> Result<String, Failure> {
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
        robots::write(file, &mut text)?;
        text.push('\n');
    }
    for info in &infos {
        contents::write(info, &mut text)?;
        text.push('\n');
    }
    Ok(text)
}
