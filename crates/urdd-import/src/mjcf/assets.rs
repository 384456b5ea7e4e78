//! The files that the URDF names.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::super::fault::{ImportFault, Unreachable};
use super::super::model::Asset;
use super::super::names::Names;
use super::super::place::{Place, TextFile};
use super::super::refusal::{Fallible, Placing};
use super::compiler::{Compiler, Compilers};
use super::document::first;
use urdd_directory::account::Charged;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::path::file_name;
use urdd_source::FoundMesh;
use urdd_source::gate::Gate;

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

/// What asking for a path costs for each of its bytes.
const LOOKED_AT: usize = 20;

/// The files that the URDF names, and where they are read.
pub struct Assets<'f> {
    gate: &'f Gate,
    compilers: &'f Compilers,
    files: &'f [TextFile],
    by_key: HashMap<String, usize>,
    /// In lower case.
    names: Names,
    pub all: Charged<Asset>,
}

impl<'f> Assets<'f> {
    /// None yet.
    pub fn new(gate: &'f Gate, compilers: &'f Compilers, files: &'f [TextFile]) -> Fallible<Self> {
        let mut names = Names::new(gate.account());
        // That of the mesh of ellipsoids.
        names.take("meshes/unit_sphere").at(Place::default())?;
        let (by_key, all) = (HashMap::new(), Charged::default());
        Ok(Assets { gate, compilers, files, by_key, names, all })
    }

    /// Finds a file that an element names.
    pub fn find(&self, file: &str, folder: Folder, place: Place) -> Fallible<FoundMesh> {
        let folder_of = |file: Option<&'f TextFile>| {
            file.and_then(|file| file.path.parent()).unwrap_or(Path::new("/"))
        };
        let first_file = self.compilers.first_file(place);
        let [base, own] = [first_file, place.file].map(|of| folder_of(self.files.get(of)));
        let places = places(file, self.compilers.at(place), folder, base, own);
        let bytes: usize = places.iter().map(|place| place.as_os_str().len()).sum();
        self.charge(LOOKED_AT * bytes, place)?;
        first(self.gate, places, file).at(place)
    }

    /// Reads a file that was found, for what is made of it.
    pub fn bytes(&self, found: &FoundMesh, place: Place) -> Fallible<Vec<u8>> {
        let unread = |why| Unreachable::unread(&found.file.display().to_string(), &why);
        self.gate.bytes(found, MAX_DOCUMENT_BYTES).map_err(unread).at(place)
    }

    /// Reads an image that was found and that begins with these bytes; `None` if it is not one.
    pub fn image(
        &self,
        found: &FoundMesh,
        start: &[u8],
        place: Place,
    ) -> Fallible<Option<Vec<u8>>> {
        let unread = |why| ImportFault::of_image(&found.file.display().to_string(), why);
        self.gate.image(found, start).map_err(unread).at(place)
    }

    /// Charges what is made at a place, in bytes.
    pub fn charge(&self, bytes: usize, place: Place) -> Fallible<()> {
        self.gate.account().charge(bytes).at(place)
    }

    /// The index of a file that was added.
    pub fn known(&self, key: &str) -> Option<usize> {
        self.by_key.get(key).copied()
    }

    /// The index of a file, which is added unless it is there. `key` tells files apart.
    pub fn add(
        &mut self,
        key: &str,
        path: &str,
        bytes: Arc<[u8]>,
        place: Place,
    ) -> Fallible<usize> {
        if let Some(known) = self.known(key) {
            return Ok(known);
        }
        let (folder, file) = path.split_once('/').unwrap_or(("", path));
        let (stem, extension) = file.rsplit_once('.').unwrap_or((file, ""));
        let stem = file_name(stem, "");
        let free = self.names.free(&format!("{folder}/{}", stem.to_lowercase())).at(place)?;
        // The number that makes it free, behind the stem as it is written.
        let number = &free[folder.len() + 1 + stem.to_lowercase().len()..];
        let path = format!("{folder}/{stem}{number}.{extension}");
        self.all.push(Asset { path, bytes }, self.gate.account()).at(place)?;
        self.by_key.insert(key.to_owned(), self.all.len() - 1);
        Ok(self.all.len() - 1)
    }
}
