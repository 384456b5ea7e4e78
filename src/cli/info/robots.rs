//! The robots of a package: their xacro files, and the arguments of these.

use std::fmt::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::cli::output::{self, about, shown};
use crate::cli::sources::around;
use urdd_directory::file_type::FileType;
use urdd_format::escape;
use urdd_source::arguments::{XacroArgument, arguments};
use urdd_source::robots::{BatchError, jobs};

/// A file of robots.
#[derive(Serialize)]
pub struct RobotFile {
    /// The file, from the current folder.
    source: String,
    /// The arguments that it takes.
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
pub fn robot_files(path: &Path) -> Result<Vec<RobotFile>, BatchError> {
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
pub fn write(file: &RobotFile, out: &mut String) -> fmt::Result {
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
