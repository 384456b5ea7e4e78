//! Reads the files that commands are given: URDDs, SRDFs.

use std::path::Path;

use super::foreign;
use super::output::{Failure, about, one_line};
use urdd_directory::discover::DiscoverError;
use urdd_directory::limits::MAX_SRDF_BYTES;
use urdd_directory::regular;
use urdd_directory::source::is_archive;
use urdd_format::escape;
use urdd_robot::Robot;

/// Opens the robot of a URDD.
///
/// # Errors
/// A message with advice if it cannot be opened.
pub fn open(path: &Path) -> Result<Robot, Failure> {
    if path.is_file() && !is_archive(path) {
        let path = path.display().to_string();
        if path.ends_with(".urdf") {
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

/// The text of an SRDF.
///
/// # Errors
/// If it cannot be read.
pub fn srdf(file: &Path) -> Result<String, Failure> {
    let unread = |error| about(file)(format!("cannot be read: {error}"));
    let bytes = regular::read(file, MAX_SRDF_BYTES).map_err(unread)?;
    Ok(String::from_utf8(bytes).map_err(|_| about(file)("it is not UTF-8"))?)
}
