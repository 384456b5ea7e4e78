//! The files that the URDF names.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use urdd_directory::path::file_name;

use super::super::model::Asset;
use super::super::names::Names;
use super::super::place::{Place, TextFile};
use super::super::reach::Reach;
use super::super::unreachable::Unreachable;
use super::compiler::Compiler;
use super::document::first;

/// Where files are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Folder {
    Meshes,
    Textures,
}

/// The places in which a file may be: below the folder of the description, or of the file that names it.
fn places(
    file: &str,
    compiler: &Compiler,
    folder: Folder,
    base: &Path,
    own: &Path,
) -> Vec<PathBuf> {
    let file = match compiler.strips_paths {
        true => file.rsplit(['/', '\\']).next().unwrap_or(file),
        false => file,
    };
    let file = file.replace('\\', "/");
    let inside = Path::new(match folder {
        Folder::Meshes => &compiler.mesh_folder,
        Folder::Textures => &compiler.texture_folder,
    });
    let between = own.strip_prefix(base).unwrap_or(Path::new(""));
    vec![
        base.join(inside).join(&file),
        own.join(&file),
        base.join(inside).join(between).join(&file),
        own.join(inside).join(&file),
    ]
}

/// The files that the URDF names, and where they are read.
pub struct Assets<'f> {
    reach: &'f Reach,
    compiler: &'f Compiler,
    files: &'f [TextFile],
    by_key: HashMap<String, usize>,
    /// In lower case.
    names: Names,
    pub all: Vec<Asset>,
}

impl<'f> Assets<'f> {
    /// None yet.
    pub fn new(reach: &'f Reach, compiler: &'f Compiler, files: &'f [TextFile]) -> Self {
        let (by_key, mut names, all) = (HashMap::new(), Names::default(), Vec::new());
        // That of the mesh of ellipsoids.
        names.take("meshes/unit_sphere");
        Assets { reach, compiler, files, by_key, names, all }
    }

    /// Reads a file that an element names.
    pub fn file(
        &self,
        file: &str,
        folder: Folder,
        place: Place,
    ) -> Result<(PathBuf, Vec<u8>), Unreachable> {
        let folder_of = |file: Option<&'f TextFile>| {
            file.and_then(|file| file.path.parent()).unwrap_or(Path::new("/"))
        };
        let [base, own] = [self.files.first(), self.files.get(place.file)].map(folder_of);
        first(self.reach, &places(file, self.compiler, folder, base, own), file)
    }

    /// The index of a file, which is added unless it is there. `key` tells files apart.
    pub fn add(&mut self, key: &str, path: &str, bytes: Arc<[u8]>) -> usize {
        if let Some(known) = self.by_key.get(key) {
            return *known;
        }
        let (folder, file) = path.split_once('/').unwrap_or(("", path));
        let (stem, extension) = file.rsplit_once('.').unwrap_or((file, ""));
        let stem = file_name(stem, "");
        let free = self.names.free(&format!("{folder}/{}", stem.to_lowercase()));
        // The number that makes it free, behind the stem as it is written.
        let number = &free[folder.len() + 1 + stem.to_lowercase().len()..];
        let path = format!("{folder}/{stem}{number}.{extension}");
        self.all.push(Asset { path, bytes });
        self.by_key.insert(key.to_owned(), self.all.len() - 1);
        self.all.len() - 1
    }
}
