//! Opens untrusted paths: regular files only, without blocking.
#![expect(clippy::disallowed_methods, reason = "it opens for reading")]

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Read};
use std::path::Path;

use crate::listing::ReadError;

/// Opens a regular file.
///
/// # Errors
/// If it cannot be opened, or is not a regular file: a folder, a pipe, a device.
pub fn open(path: &Path) -> Result<File, ReadError> {
    // Check before opening: opening a device may have side effects.
    check_kind(&fs::metadata(path)?)?;
    let file = without_waiting(path)?;
    // Check the opened file again: the path may have changed in between.
    check_kind(&file.metadata()?)?;
    Ok(file)
}

/// Reads a regular file of at most `limit` bytes, whatever size the file system reports.
///
/// # Errors
/// As for [`open()`], or if the file is longer.
pub fn read(path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    read_up_to(open(path)?, limit)
}

/// Reads a stream of at most `limit` bytes.
///
/// # Errors
/// If it cannot be read, or is longer.
pub fn read_up_to(from: impl Read, limit: u64) -> Result<Vec<u8>, ReadError> {
    let mut bytes = Vec::new();
    from.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit { Err(ReadError::TooLong { limit }) } else { Ok(bytes) }
}

/// Reads a file whose size is known, of at most `limit` bytes.
///
/// # Errors
/// If it is larger, or cannot be read.
pub fn read_sized(file: impl Read, size: u64, limit: u64) -> Result<Vec<u8>, ReadError> {
    let fits =
        |size: u64| if size > limit { Err(ReadError::TooLarge { size, limit }) } else { Ok(()) };
    fits(size)?;
    // Allocate once, with room for the read that detects the end.
    let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or_default() + 32);
    // The file may grow while it is read: enforce the limit again.
    file.take(limit + 1).read_to_end(&mut bytes)?;
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
