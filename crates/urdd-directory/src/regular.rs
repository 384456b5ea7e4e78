//! Opening files that somebody names: regular files only, and without waiting.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Read};
use std::path::Path;

use super::read_error::ReadError;

/// Opens a regular file.
///
/// # Errors
/// Where it cannot be opened, or is something else: a folder, a pipe, a device.
pub fn open(path: &Path) -> Result<File, ReadError> {
    let from_io = |error: io::Error| ReadError::from_io(&error);
    // Looked at first: opening a device may do something to it.
    check_kind(&fs::metadata(path).map_err(from_io)?)?;
    let file = without_waiting(path).map_err(from_io)?;
    // And again, of what was opened: the path may lead elsewhere by now.
    check_kind(&file.metadata().map_err(from_io)?)?;
    Ok(file)
}

/// Reads a regular file of at most `limit` bytes, whatever the file system says of its size.
///
/// # Errors
/// As for [`open()`], and where it is longer.
pub fn read(path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    let mut bytes = Vec::new();
    open(path)?
        .take(limit + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| ReadError::from_io(&error))?;
    if bytes.len() as u64 > limit {
        return Err(ReadError::TooLong { limit });
    }
    Ok(bytes)
}

fn check_kind(metadata: &Metadata) -> Result<(), ReadError> {
    if metadata.is_file() {
        Ok(())
    } else {
        Err(ReadError::NotAFile)
    }
}

/// Opens a file without waiting for anything: a pipe may have taken its place, and some files of the
/// kernel wait for their next line.
fn without_waiting(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.read(true);
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    {
        use std::os::unix::fs::OpenOptionsExt;
        let flags = rustix::fs::OFlags::NONBLOCK | rustix::fs::OFlags::NOCTTY;
        options.custom_flags(flags.bits().cast_signed());
    }
    options.open(path)
}
