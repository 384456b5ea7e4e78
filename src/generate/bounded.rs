//! Reading files of any size and kind, and not more than is good.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

/// Reads a regular file of at most `limit` bytes.
///
/// # Errors
/// Why it cannot be read, in words.
pub(super) fn read_file(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    let metadata = fs::metadata(path).map_err(|error| error.to_string())?;
    if metadata.is_dir() {
        return Err("it is a folder".to_owned());
    }
    if !metadata.is_file() {
        return Err("it is not a regular file".to_owned());
    }
    let file = File::open(path).map_err(|error| error.to_string())?;
    let mut bytes = Vec::new();
    file.take(limit + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| error.to_string())?;
    if bytes.len() as u64 > limit {
        return Err(format!("it is longer than {} MiB", limit >> 20));
    }
    Ok(bytes)
}
