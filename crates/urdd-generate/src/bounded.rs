//! Reads files with a size limit.

use std::io::Read;
use std::path::Path;

use urdd_directory::regular;

/// Maximum size of a URDF in bytes. The validator has the same limit.
pub const MAX_SOURCE_BYTES: u64 = 64 << 20;

/// Reads a regular file of at most `limit` bytes, whatever size the file system reports.
///
/// # Errors
/// The reason why it cannot be read.
pub(super) fn read_file(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    if path.is_dir() {
        return Err("it is a folder".to_owned());
    }
    let file = regular::open(path).map_err(|error| error.to_string())?;
    read_up_to(file, limit)
}

/// Reads at most `limit` bytes.
///
/// # Errors
/// The reason why it cannot be read, or that it is longer.
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
