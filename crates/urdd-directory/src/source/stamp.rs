//! What tells whether a file or folder is what it was.

use std::fs::{File, Metadata};
use std::time::{SystemTime, UNIX_EPOCH};

/// What tells one state of a file or folder from another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stamp {
    /// Device and inode number, where there are any.
    place: Option<(u64, u64)>,
    size: u64,
    changed: SystemTime,
}

impl Stamp {
    /// The stamp of what this is the metadata of.
    pub fn of(metadata: &Metadata) -> Self {
        #[cfg(unix)]
        let (place, changed) = {
            use std::os::unix::fs::MetadataExt;
            use std::time::Duration;
            let [seconds, nanoseconds] = [metadata.ctime(), metadata.ctime_nsec()];
            let since = Duration::new(seconds.unsigned_abs(), nanoseconds.unsigned_abs() as u32);
            (Some((metadata.dev(), metadata.ino())), UNIX_EPOCH + since)
        };
        #[cfg(not(unix))]
        let (place, changed) = (None, metadata.modified().unwrap_or(UNIX_EPOCH));
        Stamp { place, size: metadata.len(), changed }
    }

    /// Bytes.
    pub(super) fn size(&self) -> u64 {
        self.size
    }

    /// The time of the last change.
    pub(super) fn changed(&self) -> SystemTime {
        self.changed
    }

    pub(super) fn is_of(&self, file: &File) -> bool {
        file.metadata().is_ok_and(|metadata| Stamp::of(&metadata) == *self)
    }
}

/// What an entry of a folder was.
#[derive(Debug, PartialEq)]
pub(super) enum Seen {
    Itself(Stamp),
    /// A link to this path below the root.
    Leads(String),
    Other,
}
