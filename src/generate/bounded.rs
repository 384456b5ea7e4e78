//! Reading files of any size and kind, and not more than is good.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read};
use std::path::Path;

/// Longest URDF that is read, bytes; the validator reads no longer one.
pub const MAX_SOURCE_BYTES: u64 = 64 << 20;

/// Reads a regular file of at most `limit` bytes, whatever the file system says of its size.
///
/// # Errors
/// Why it cannot be read, in words.
pub(super) fn read_file(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    // Looked at first: opening a device may do something to it.
    check_kind(&fs::metadata(path).map_err(|error| error.to_string())?)?;
    let file = open(path).map_err(|error| error.to_string())?;
    // And again, of what was opened: the path may lead elsewhere by now.
    check_kind(&file.metadata().map_err(|error| error.to_string())?)?;
    read_up_to(file, limit)
}

/// Reads at most `limit` bytes of anything.
///
/// # Errors
/// Why it cannot be read, or that there is more, in words.
pub(super) fn read_up_to(from: impl Read, limit: u64) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    from.take(limit + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| error.to_string())?;
    if bytes.len() as u64 > limit {
        return Err(format!("it is longer than {} MiB", limit >> 20));
    }
    Ok(bytes)
}

fn check_kind(metadata: &fs::Metadata) -> Result<(), String> {
    if metadata.is_dir() {
        return Err("it is a folder".to_owned());
    }
    if !metadata.is_file() {
        return Err("it is not a regular file".to_owned());
    }
    Ok(())
}

/// Opens a file without waiting for anything: a pipe may have taken its place, and some files of the
/// kernel wait for their next line.
fn open(path: &Path) -> io::Result<File> {
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
