//! Size limits of what is read.

use std::io::Read;

/// Maximum size of a URDF in bytes. The validator has the same limit.
pub const MAX_SOURCE_BYTES: u64 = 64 << 20;

/// Reads at most `limit` bytes.
///
/// # Errors
/// The reason why it cannot be read, or that it is longer.
pub(super) fn read_up_to(from: impl Read, limit: u64) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    from.take(limit + 1).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() as u64 > limit {
        return Err(format!("it is longer than {} MiB", limit >> 20));
    }
    Ok(bytes)
}
