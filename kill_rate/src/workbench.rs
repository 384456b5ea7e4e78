//! A copy of a URDD on disk, to apply and undo mutations one by one.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;

use tempfile::TempDir;

use super::mutation::Files;
use super::original::Original;

/// A copy of a URDD.
pub(crate) struct Workbench<'a> {
    folder: TempDir,
    files: &'a BTreeMap<String, Vec<u8>>,
}

impl<'a> Workbench<'a> {
    /// Copies a URDD into a temporary folder.
    pub(crate) fn new(original: &'a Original) -> io::Result<Self> {
        let workbench = Workbench { folder: TempDir::new()?, files: &original.files };
        for (path, bytes) in workbench.files {
            workbench.write(path, bytes)?;
        }
        Ok(workbench)
    }

    /// Calls `look` on the URDD with some files changed, then restores them.
    pub(crate) fn with<T>(&self, changed: &Files, look: impl FnOnce(&Path) -> T) -> io::Result<T> {
        let root = self.folder.path();
        for (path, bytes) in changed {
            match bytes {
                Some(bytes) => self.write(path, bytes)?,
                None => self.remove(path)?,
            }
        }
        let seen = look(root);
        for path in changed.keys() {
            match self.files.get(path) {
                Some(bytes) => self.write(path, bytes)?,
                None => self.remove(path)?,
            }
        }
        Ok(seen)
    }

    fn write(&self, path: &str, bytes: &[u8]) -> io::Result<()> {
        let file = self.folder.path().join(path);
        if let Some(parent) = file.parent() {
            fs::create_dir_all(parent)?;
        }
        fs::write(file, bytes)
    }

    /// Removes a file, and parent folders that become empty: an empty folder would still count as a module.
    fn remove(&self, path: &str) -> io::Result<()> {
        let root = self.folder.path();
        let file = root.join(path);
        fs::remove_file(&file)?;
        let parents = file.ancestors().skip(1);
        for folder in parents.take_while(|folder| *folder != root) {
            if fs::remove_dir(folder).is_err() {
                break;
            }
        }
        Ok(())
    }
}
