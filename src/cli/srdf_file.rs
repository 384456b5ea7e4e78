//! Reads an SRDF.

use std::path::Path;

use urdd_directory::regular;
use urdd_format::escape;

/// Maximum size, in bytes.
const MAX_BYTES: u64 = 16 << 20;

/// The text of an SRDF.
pub fn read(file: &Path) -> Result<String, String> {
    let shown = escape::line(&file.display().to_string()).into_owned();
    let bytes = regular::read(file, MAX_BYTES);
    let bytes = bytes.map_err(|error| format!("{shown}: cannot be read: {error}"))?;
    String::from_utf8(bytes).map_err(|_| format!("{shown}: it is not UTF-8"))
}
