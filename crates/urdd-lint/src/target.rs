//! Which file a fix is written to, and which files are left alone.

use std::fs::{self, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why a file is left as it is.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LeftAlone {
    /// A link in a folder that was named leads to a file that is in none.
    #[error("the link leads to {}, outside of what was named; name that file to mend it", .0.display())]
    Outside(PathBuf),
    /// It has several names, and a new file has one of them.
    #[error(
        "the file has {0} names (hard links), and the others would keep the old text; --force mends this one"
    )]
    HardLinks(u64),
    /// It may not be written to.
    #[error("the file is read-only; make it writable, or mend it with --force")]
    ReadOnly,
}

/// The file that a path leads to, with links resolved. `named` are the paths on the command line; `is_forced` allows files
/// that are read-only or have several names.
pub fn target(
    path: &Path,
    named: &[PathBuf],
    is_forced: bool,
) -> io::Result<Result<PathBuf, LeftAlone>> {
    let target = path.canonicalize()?;
    let mut named = named.iter().filter_map(|named| named.canonicalize().ok());
    if !named.any(|named| target.starts_with(named)) {
        return Ok(Err(LeftAlone::Outside(target)));
    }
    let metadata = fs::metadata(&target)?;
    let names = names(&metadata);
    if names > 1 && !is_forced {
        return Ok(Err(LeftAlone::HardLinks(names)));
    }
    // Another user's file has bits that count for that user alone.
    #[expect(clippy::disallowed_methods, reason = "it asks whether it could, and writes nothing")]
    let is_refused = || {
        let opened = OpenOptions::new().write(true).open(&target);
        opened.is_err_and(|error| error.kind() == io::ErrorKind::PermissionDenied)
    };
    if !is_forced && (metadata.permissions().readonly() || is_refused()) {
        return Ok(Err(LeftAlone::ReadOnly));
    }
    Ok(Ok(target))
}

#[cfg(unix)]
fn names(metadata: &fs::Metadata) -> u64 {
    std::os::unix::fs::MetadataExt::nlink(metadata)
}

/// Elsewhere, the standard library does not say.
#[cfg(not(unix))]
fn names(_: &fs::Metadata) -> u64 {
    1
}
