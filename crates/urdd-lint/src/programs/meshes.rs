//! The mesh files that programs ask for.

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_programs::{Mesh, MeshFacts};
use urdd_source::resolve::resolve;
use urdd_source::roots::Roots;

use crate::settings::LintSettings;

/// The mesh files around a URDF, each looked at once.
pub struct MeshFiles<'a> {
    folder: PathBuf,
    settings: &'a LintSettings,
    roots: Roots,
    known: RefCell<HashMap<String, Mesh>>,
}

impl<'a> MeshFiles<'a> {
    pub fn new(folder: &Path, settings: &'a LintSettings) -> Self {
        let folder = settings.source.files.canonicalize(folder);
        let folder = folder.unwrap_or_else(|_| PathBuf::from("."));
        let roots = Roots::new(&folder, &settings.source);
        MeshFiles { folder, settings, roots, known: RefCell::default() }
    }

    /// What is there under a name. Where packages are missing, or files are outside of those that may be read, nothing is known.
    pub fn mesh(&self, name: &str) -> Mesh {
        if self.settings.without_meshes {
            return Mesh::Unknown;
        }
        if let Some(known) = self.known.borrow().get(name) {
            return known.clone();
        }
        let mesh = self.look(name);
        self.known.borrow_mut().insert(name.to_owned(), mesh.clone());
        mesh
    }

    fn look(&self, name: &str) -> Mesh {
        // A program may fetch it.
        if ["http://", "https://", "ftp://"].iter().any(|scheme| name.starts_with(scheme)) {
            return Mesh::Unknown;
        }
        let found = resolve(name, &self.folder, &self.settings.source.packages, &self.roots);
        match found {
            // Other programs take names as they are written.
            Ok(found) if found.assumed.is_some() || name.trim() != name => Mesh::Missing,
            Ok(found) => match self.roots.files().read(&found.file, MAX_DOCUMENT_BYTES) {
                Ok(bytes) => Mesh::Found(Arc::new(MeshFacts::of(name, &bytes))),
                Err(_) => Mesh::Unknown,
            },
            Err(why) if why.no_package.is_some() || why.outside.is_some() => Mesh::Unknown,
            Err(_) => Mesh::Missing,
        }
    }
}
