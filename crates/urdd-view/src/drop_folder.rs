//! The temporary folder of what is dropped on the page.

use std::fs;
use std::path::{Path, PathBuf};

use parking_lot::Mutex;

use crate::reply::{Result, failed, refused};

/// Maximum size of all drops, bytes.
const MAX_TOTAL: u64 = 1 << 30;

/// Where dropped files go.
#[derive(Debug)]
pub struct Drops {
    folder: PathBuf,
    /// Whether xacro files may run.
    pub(super) with_xacro: bool,
    taken: Mutex<Taken>,
}

#[derive(Debug, Default)]
struct Taken {
    drops: usize,
    bytes: u64,
}

impl Drops {
    /// Drops into a folder, created when the first one comes.
    pub(super) fn new(folder: PathBuf, with_xacro: bool) -> Self {
        Drops { folder, with_xacro, taken: Mutex::default() }
    }

    /// Whether a file is in what was dropped.
    pub(super) fn holds(&self, file: &Path) -> bool {
        file.starts_with(&self.folder)
    }

    /// A new folder for so many bytes.
    pub(super) fn begin(&self, bytes: u64) -> Result<PathBuf> {
        let mut taken = self.taken.lock();
        if taken.bytes.saturating_add(bytes) > MAX_TOTAL {
            return refused(
                413,
                "more than 1 GiB was dropped; give the path to `urdd view` instead",
            );
        }
        taken.bytes += bytes;
        taken.drops += 1;
        let folder = self.folder.join(taken.drops.to_string());
        fs::create_dir_all(&folder).map_err(failed(500))?;
        Ok(folder)
    }
}
