//! Reads the files that commands are given: URDDs, SRDFs.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::foreign;
use super::output::{self, Failure, about, one_line, shown};
use super::packages::around;
use super::signals;
use super::xacro;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::DiscoverError;
use urdd_directory::file_type::FileType;
use urdd_directory::limits::MAX_SRDF_BYTES;
use urdd_directory::regular;
use urdd_directory::source::is_archive;
use urdd_format::escape;
use urdd_robot::Robot;
use urdd_source::{Settings, XacroSettings, read_source};

/// Opens the robot of a URDD.
///
/// # Errors
/// A message with advice if it cannot be opened.
pub fn open(path: &Path) -> Result<Robot, Failure> {
    if path.is_file() && !is_archive(path) {
        let is_urdf = FileType::Urdf.is_of(path);
        let path = path.display().to_string();
        if is_urdf {
            Err(format!(
                "{}: this is a URDF; generate a URDD from it first: urdd generate {} -o DIR",
                one_line(&path),
                escape::shell(&path)
            ))?;
        }
        Err(foreign::advice(&DiscoverError::NotAFolder { path }))?;
    }
    Ok(Robot::open(path).map_err(one_line)?)
}

/// Prints what `work` makes of the text of an SRDF; of one that is xacro, of what xacro makes of it with these words of the
/// command line.
pub fn with_srdf(
    file: &Path,
    words: &[PathBuf],
    work: impl FnOnce(&str) -> Result<String, Failure>,
) -> ExitCode {
    signals::run(None, |signals| {
        let text = srdf_or_xacro(file, words, signals.cancellation())?;
        output::print(&work(&text)?)?;
        Ok(0)
    })
}

fn srdf_or_xacro(
    file: &Path,
    words: &[PathBuf],
    cancellation: Cancellation,
) -> Result<String, Failure> {
    let arguments = xacro::only_arguments(words)?;
    if !FileType::Xacro.is_of(file) {
        return match arguments.first() {
            None => srdf(file),
            Some(argument) => Err(format!(
                "{}: not a xacro file, so that `{}` has no meaning",
                shown(file),
                one_line(argument)
            ))?,
        };
    }
    let settings =
        Settings { xacro: XacroSettings { arguments, ..XacroSettings::default() }, ..around() };
    Ok(read_source(file, &settings, &cancellation).map_err(one_line)?.text)
}

/// The text of an SRDF.
///
/// # Errors
/// If it cannot be read.
pub fn srdf(file: &Path) -> Result<String, Failure> {
    let unread = |error| about(file)(format!("cannot be read: {error}"));
    let bytes = regular::read(file, MAX_SRDF_BYTES).map_err(unread)?;
    Ok(String::from_utf8(bytes).map_err(|_| about(file)("it is not UTF-8"))?)
}
