//! A folder that contains one URDD after another.

use std::collections::BTreeMap;

use tempfile::TempDir;

use super::fixture::Fixture;

/// A folder on disk. Files that two consecutive URDDs share are written once, so that thousands of URDDs with few
/// differences take little time.
pub struct Folder {
    folder: TempDir,
    holds: BTreeMap<String, Vec<u8>>,
}

impl Default for Folder {
    fn default() -> Self {
        Self::new()
    }
}

impl Folder {
    /// An empty folder.
    pub fn new() -> Folder {
        Folder { folder: crate::temporary::folder(), holds: BTreeMap::new() }
    }

    /// Replaces the content of the folder by this URDD.
    pub fn put(&mut self, urdd: &Fixture) -> &std::path::Path {
        let root = self.folder.path();
        self.holds.retain(|path, _| {
            let stays = urdd.files.contains_key(path);
            if !stays {
                std::fs::remove_file(root.join(path)).expect("a file that we wrote");
            }
            stays
        });
        for (path, bytes) in &urdd.files {
            if self.holds.get(path) != Some(bytes) {
                let file = root.join(path);
                std::fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
                std::fs::write(file, bytes).expect("a file");
                self.holds.insert(path.clone(), bytes.clone());
            }
        }
        root
    }
}
