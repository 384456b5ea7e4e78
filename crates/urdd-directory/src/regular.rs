//! Opens untrusted paths: regular files only, without blocking.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Read};
use std::path::Path;

use super::read_error::ReadError;

/// Opens a regular file.
///
/// # Errors
/// If it cannot be opened, or is not a regular file: a folder, a pipe, a device.
pub fn open(path: &Path) -> Result<File, ReadError> {
    let from_io = |error: io::Error| ReadError::from_io(&error);
    // Check before opening: opening a device may have side effects.
    check_kind(&fs::metadata(path).map_err(from_io)?)?;
    let file = without_waiting(path).map_err(from_io)?;
    // Check the opened file again: the path may have changed in between.
    check_kind(&file.metadata().map_err(from_io)?)?;
    Ok(file)
}

/// Reads a regular file of at most `limit` bytes, whatever size the file system reports.
///
/// # Errors
/// As for [`open()`], or if the file is longer.
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

/// Reads a file whose size is known, of at most `limit` bytes.
///
/// # Errors
/// If it is larger, or cannot be read.
pub(crate) fn read_sized(file: impl Read, size: u64, limit: u64) -> Result<Vec<u8>, ReadError> {
    let fits = |size: u64| match size > limit {
        true => Err(ReadError::TooLarge { size, limit }),
        false => Ok(()),
    };
    fits(size)?;
    // Allocate once, with room for the read that detects the end.
    let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or_default() + 32);
    // The file may grow while it is read: enforce the limit again.
    file.take(limit + 1).read_to_end(&mut bytes).map_err(|error| ReadError::from_io(&error))?;
    fits(bytes.len() as u64)?;
    Ok(bytes)
}

fn check_kind(metadata: &Metadata) -> Result<(), ReadError> {
    if metadata.is_file() { Ok(()) } else { Err(ReadError::NotAFile) }
}

/// Opens without blocking: a pipe may have replaced the file, and some kernel files block until their next line.
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
