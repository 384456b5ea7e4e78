//! `urdd info`.

mod contents;
mod parts;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::output;
use contents::Info;
use urdd_directory::discover::discover;
use urdd_format::escape;
use urdd_validate::report;

/// Arguments of `urdd info`.
#[derive(Args)]
pub struct InfoArguments {
    /// URDDs, or folders with URDDs at any depth.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,

    /// Output format.
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Text for people.
    Human,
    /// JSON: a list with an object per URDD.
    Json,
}

/// Runs `urdd info`.
pub fn run(arguments: &InfoArguments) -> ExitCode {
    output::printed(tell(arguments).and_then(|text| output::print(&text)))
}

fn tell(arguments: &InfoArguments) -> Result<String, String> {
    let mut infos = Vec::new();
    for path in &arguments.paths {
        for found in
            discover(path).map_err(|error| escape::line(&error.to_string()).into_owned())?
        {
            if let Some(error) = found.closed {
                return Err(format!("{}: {error}", escape::line(&found.name)));
            }
            let info = Info::read(&found.path, &found.name)
                .map_err(|error| format!("{}: {error}", escape::line(&found.name)))?;
            infos.push(info);
        }
    }
    if arguments.format == Format::Json {
        return report::json(&infos).map_err(|error| error.to_string());
    }
    let mut text = String::new();
    for info in &infos {
        contents::write(info, &mut text).map_err(|error| error.to_string())?;
        text.push('\n');
    }
    Ok(text)
}
