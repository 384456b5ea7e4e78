//! The product of a stage: built in this run, or read from the files of a kept module when a later stage first needs it.

use std::sync::{Arc, OnceLock};

use serde::de::DeserializeOwned;

use super::donor;
use super::error::{GenerateError, Result};
use super::meshes::written::{Meshes, Pieces, read_mesh};
use urdd_directory::root::Root;
use urdd_format::convex_decomposition_meshes::ConvexDecompositionMeshesModule;
use urdd_format::convex_hull_meshes::ConvexHullMeshesModule;
use urdd_format::meshes::MeshFiles;
use urdd_format::plain_meshes::PlainMeshesModule;
use urdd_format::registry::ModuleKind;

/// Reads the product of a stage from the files of its module.
pub(super) type Load<T> = fn(&Root, ModuleKind) -> Result<T>;

pub(super) struct Product<T> {
    known: OnceLock<T>,
    kind: ModuleKind,
    root: Root,
    load: Load<T>,
}

impl<T> Product<T> {
    /// What a stage returned. Without it, `load` reads it from the URDD in `root`.
    pub fn new(made: Option<T>, kind: ModuleKind, root: Root, load: Load<T>) -> Self {
        let known = made.map_or_else(OnceLock::new, OnceLock::from);
        Product { known, kind, root, load }
    }

    /// Returns the product; the first call reads it if this run did not build it.
    pub fn get(&self) -> Result<&T> {
        match self.known.get() {
            Some(known) => Ok(known),
            None => {
                let loaded = (self.load)(&self.root, self.kind)?;
                Ok(self.known.get_or_init(|| loaded))
            }
        }
    }
}

pub(super) fn document<T: DeserializeOwned>(root: &Root, kind: ModuleKind) -> Result<Arc<T>> {
    let read = donor::document(root, kind).map(Arc::new);
    read.map_err(|reason| GenerateError::internal(kind.folder(), reason))
}

pub(super) fn plain(root: &Root, kind: ModuleKind) -> Result<Meshes> {
    let module: Arc<PlainMeshesModule> = document(root, kind)?;
    let links = module.link_meshes.iter().map(Option::as_ref);
    one_each(root, links.map(|link| link.map(|mesh| &mesh.files)))
}

pub(super) fn hulls(root: &Root, kind: ModuleKind) -> Result<Meshes> {
    let module: Arc<ConvexHullMeshesModule> = document(root, kind)?;
    one_each(root, module.link_hulls.iter().map(Option::as_ref))
}

fn one_each<'a>(root: &Root, links: impl Iterator<Item = Option<&'a MeshFiles>>) -> Result<Meshes> {
    links.map(|link| link.map(|files| read_mesh(root, files))).map(Option::transpose).collect()
}

pub(super) fn pieces(root: &Root, kind: ModuleKind) -> Result<Pieces> {
    let module: Arc<ConvexDecompositionMeshesModule> = document(root, kind)?;
    let links = module.link_pieces.iter();
    links.map(|link| link.iter().map(|files| read_mesh(root, files)).collect()).collect()
}
