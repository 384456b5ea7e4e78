//! The mesh files that programs ask for.

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_programs::{Mesh, MeshFacts};
use urdd_source::FoundMesh;
use urdd_source::gate::Gate;

use crate::settings::LintSettings;

/// Maximum length of a name that is looked for once, bytes.
const MOST_BYTES: usize = 250;

/// The mesh files around a URDF. Each name is looked for once, and each file is read once.
pub struct MeshFiles<'a> {
    folder: PathBuf,
    settings: &'a LintSettings,
    gate: Gate,
    by_name: RefCell<HashMap<String, Mesh>>,
    /// By the ending of their names, which says as what a file is read.
    by_file: RefCell<HashMap<(PathBuf, String), Mesh>>,
}

impl<'a> MeshFiles<'a> {
    pub fn new(folder: &Path, settings: &'a LintSettings) -> Self {
        let folder = settings.source.files.canonicalize(folder);
        let folder = folder.unwrap_or_else(|_| PathBuf::from("."));
        let gate = Gate::new(&folder, &settings.source);
        let (by_name, by_file) = (RefCell::default(), RefCell::default());
        MeshFiles { folder, settings, gate, by_name, by_file }
    }

    /// What is there under a name. Where packages are missing, or files are outside of those that may be read, nothing is known.
    pub fn mesh(&self, name: &str) -> Mesh {
        if self.settings.without_meshes {
            return Mesh::Unknown;
        }
        if let Some(known) = self.by_name.borrow().get(name) {
            return known.clone();
        }
        let mesh = match name.split_once("://") {
            // A program may fetch it.
            Some(("http" | "https" | "ftp", _)) => Mesh::Unknown,
            Some(_) => self.packaged(name),
            None => self.plain(name),
        };
        // Programs put folders before names: many long ones are not kept.
        if name.len() <= MOST_BYTES {
            self.by_name.borrow_mut().insert(name.to_owned(), mesh.clone());
        }
        mesh
    }

    /// A path from the URDF's folder. Most of those that programs try are not there.
    fn plain(&self, name: &str) -> Mesh {
        let path = self.folder.join(name);
        if name.is_empty() || !self.gate.files().is_file(&path) {
            return Mesh::Missing;
        }
        self.gate.at(&path).map_or(Mesh::Unknown, |found| self.read(&found, name))
    }

    fn packaged(&self, name: &str) -> Mesh {
        match self.gate.find(name) {
            // Other programs take names as they are written.
            Ok(found) if found.assumed.is_some() || name.trim() != name => Mesh::Missing,
            Ok(found) => self.read(&found, name),
            Err(why) if why.no_package.is_some() || why.outside.is_some() => Mesh::Unknown,
            Err(_) => Mesh::Missing,
        }
    }

    fn read(&self, found: &FoundMesh, name: &str) -> Mesh {
        let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_lowercase();
        let key = (found.file.clone(), ending);
        if let Some(known) = self.by_file.borrow().get(&key) {
            return known.clone();
        }
        let bytes = self.gate.bytes(found, MAX_DOCUMENT_BYTES);
        let facts = bytes.map(|bytes| Arc::new(MeshFacts::of(name, &bytes)));
        let mesh = facts.map_or(Mesh::Unknown, Mesh::Found);
        self.by_file.borrow_mut().insert(key, mesh.clone());
        mesh
    }
}
