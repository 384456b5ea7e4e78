//! Every path in the documents of a URDD, independent of module and version, and the mesh files that they lead to: in
//! version 1 inside the URDD, in legacy versions inside it or a sibling URDD. Never opens anything else.

use std::collections::HashMap;

use thiserror::Error;

use crate::meshes;
use crate::module::Module;
use crate::urdd::Urdd;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::path::{self, PathFault};
use urdd_directory::root::{ReadError, Root};
use urdd_directory::source::OpenFile;
use urdd_format::registry::{ModuleDocument, Profile};
use urdd_format::root_metadata::{RootMetadata, Source};

/// A path in a document.
#[derive(Clone)]
pub struct NamedPath<'a> {
    /// The module with the document; `None` for `urdd.json`.
    pub module: Option<&'a Module>,
    /// JSON Pointer in the document.
    pub pointer: String,
    /// The path as written: relative to the root, or in legacy modules to the parent folder of the root.
    pub path: &'a str,
    /// Whether an element of the URDF uses the file here (version 1). Several elements may use one file.
    pub is_reference: bool,
}

/// Where a path leads, judged by its text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place<'a> {
    /// A path within the root.
    Here(&'a str),
    /// A path within a sibling URDD (legacy).
    Sibling {
        /// Name of the sibling's folder.
        folder: &'a str,
        /// The path within that folder.
        path: &'a str,
    },
    /// An invalid path.
    Nowhere(PathFault),
}

impl<'a> NamedPath<'a> {
    /// The document's file, relative to the root.
    pub fn file(&self) -> String {
        match self.module {
            Some(module) => module.file("module.json"),
            None => ROOT_METADATA.to_owned(),
        }
    }

    /// Whether the path is relative to the parent folder of the root, as in legacy modules.
    pub fn from_parent(&self) -> bool {
        self.module.is_some_and(Module::is_legacy)
    }

    /// Where the path leads.
    pub fn place(&self, urdd: &Urdd) -> Place<'a> {
        if let Err(fault) = path::check(self.path) {
            return Place::Nowhere(fault);
        }
        if !self.from_parent() {
            return Place::Here(self.path);
        }
        match self.path.split_once('/') {
            Some((folder, path)) if folder == urdd.root().folder_name() => Place::Here(path),
            Some((folder, path)) => Place::Sibling { folder, path },
            None => Place::Sibling { folder: self.path, path: "" },
        }
    }
}

/// Every path in `urdd.json` and the modules' documents, in document order. Skips documents that break their schema.
pub fn all(urdd: &Urdd) -> Vec<NamedPath<'_>> {
    let mut paths = match urdd.metadata() {
        Some(metadata) => of_metadata(metadata),
        None => Vec::new(),
    };
    for module in urdd.modules() {
        paths.extend(of_module(module));
    }
    paths
}

/// Every path in `urdd.json`.
pub fn of_metadata<'a>(metadata: &'a RootMetadata) -> Vec<NamedPath<'a>> {
    let mut paths = Vec::new();
    let mut add = |pointer: String, path: &'a str| paths.push(named(None, pointer, path));
    if let Some(Source::Urdf(file)) = &metadata.source {
        add("/source/Urdf/path".to_owned(), &file.path);
    }
    for (m, module) in metadata.modules.iter().enumerate() {
        add(format!("/modules/{m}/path"), &module.path);
        for (f, file) in module.files.iter().enumerate() {
            add(format!("/modules/{m}/files/{f}/path"), &file.path);
        }
    }
    paths
}

/// Every path in a module's document.
pub fn of_module<'a>(module: &'a Module) -> Vec<NamedPath<'a>> {
    let mut paths = Vec::new();
    let mut add = |pointer: String, path: &'a str, is_reference| {
        paths.push(NamedPath { is_reference, ..named(Some(module), pointer, path) });
    };
    match &module.document {
        Some(ModuleDocument::OriginalMeshes(meshes)) => {
            for (i, reference) in meshes.references.iter().enumerate() {
                if let Some(path) = &reference.path {
                    add(format!("/references/{i}/path"), path, true);
                }
            }
            for (i, mesh) in meshes.files.iter().enumerate() {
                add(format!("/files/{i}/path"), &mesh.path, false);
                for (j, side) in mesh.side_files.iter().enumerate() {
                    add(format!("/files/{i}/side_files/{j}"), side, false);
                }
            }
        }
        Some(document) => {
            for list in meshes::view(document).into_iter().flat_map(|view| view.lists) {
                for path in list.links.into_iter().flatten().flat_map(|mesh| mesh.paths) {
                    add(path.pointer, path.path, false);
                }
            }
        }
        None => {}
    }
    paths
}

fn named<'a>(module: Option<&'a Module>, pointer: String, path: &'a str) -> NamedPath<'a> {
    NamedPath { module, pointer, path, is_reference: false }
}

/// Why a mesh file is not available.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum Absence {
    #[error("there is no such file")]
    Missing,
    #[error("it is in the URDD `{}`, which is not beside this one", .0.escape_debug())]
    NoSibling(String),
    /// The path is invalid, or the file cannot be read. Other rules report this.
    #[error(transparent)]
    Other(ReadError),
}

/// Resolves the paths of one URDD, and caches its siblings.
pub struct MeshFiles<'a> {
    urdd: &'a Urdd,
    own_name: String,
    siblings: HashMap<String, Option<Root>>,
}

impl<'a> MeshFiles<'a> {
    /// A resolver for a URDD.
    pub fn new(urdd: &'a Urdd) -> Self {
        MeshFiles { urdd, own_name: urdd.root().folder_name(), siblings: HashMap::new() }
    }

    /// The path relative to the URDD's root, if it is inside the URDD.
    pub fn own<'p>(&self, profile: Profile, path: &'p str) -> Option<&'p str> {
        match profile {
            Profile::V1 => Some(path),
            Profile::Legacy => path.strip_prefix(self.own_name.as_str())?.strip_prefix('/'),
        }
    }

    /// Checks that there is a file at a path.
    ///
    /// # Errors
    /// Why it is not available.
    pub fn find(&mut self, profile: Profile, path: &str) -> Result<(), Absence> {
        if let Some(own) = self.own(profile, path)
            && self.urdd.listing().has_file(own)
        {
            return Ok(());
        }
        self.open(profile, path).map(|_| ())
    }

    /// Opens the file at a path, and returns its size.
    ///
    /// # Errors
    /// Why it is not available.
    pub fn open(&mut self, profile: Profile, path: &str) -> Result<(OpenFile, u64), Absence> {
        self.at(profile, path, Root::open_file)
    }

    /// The bytes of the file at a path.
    ///
    /// # Errors
    /// Why it is not available, or too large.
    pub fn read(&mut self, profile: Profile, path: &str) -> Result<Vec<u8>, Absence> {
        self.at(profile, path, |root, path| root.read(path, MAX_DOCUMENT_BYTES))
    }

    fn at<T>(
        &mut self,
        profile: Profile,
        path: &str,
        get: impl FnOnce(&Root, &str) -> Result<T, ReadError>,
    ) -> Result<T, Absence> {
        path::check(path).map_err(|fault| Absence::Other(ReadError::Path(fault)))?;
        let got = match self.own(profile, path) {
            Some(own) => get(self.urdd.root(), own),
            None => {
                let (folder, rest) = path.split_once('/').ok_or(Absence::Missing)?;
                let urdd = self.urdd;
                let sibling = self
                    .siblings
                    .entry(folder.to_owned())
                    .or_insert_with(|| urdd.root().sibling(folder));
                match sibling {
                    Some(root) => get(root, rest),
                    None => return Err(Absence::NoSibling(folder.to_owned())),
                }
            }
        };
        got.map_err(|error| match error {
            ReadError::Missing => Absence::Missing,
            other => Absence::Other(other),
        })
    }
}
