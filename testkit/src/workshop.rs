//! A folder in which tests change our robots.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

/// Our robots' URDFs with their meshes, and changed URDFs beside them.
pub struct Workshop {
    folder: TempDir,
}

impl Workshop {
    /// With our robots as they are.
    #[allow(clippy::new_without_default, reason = "it writes files")]
    pub fn new() -> Workshop {
        let folder = crate::temporary::folder();
        let robots = crate::repository().join("conformance/robots");
        for (path, bytes) in crate::files::below(&robots) {
            let is_needed = path.starts_with("meshes/") || path == "package.xml";
            if is_needed || path.ends_with(".urdf") {
                let file = folder.path().join(path);
                fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
                fs::write(file, bytes).expect("a file");
            }
        }
        Workshop { folder }
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// The path of a file in it.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The URDF of one of our robots.
    pub fn text(&self, robot: &str) -> String {
        fs::read_to_string(self.path(&format!("{robot}.urdf"))).expect("a robot")
    }

    /// Writes a file, and returns its path.
    pub fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, text).expect("written");
        path
    }
}
