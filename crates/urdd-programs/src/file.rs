//! What a reader is asked about.

use crate::mesh::Mesh;
use crate::tinyxml::Document;

/// A URDF, and the mesh files that it names.
pub struct File<'a> {
    /// The file as it is on disk.
    pub(crate) bytes: &'a [u8],
    /// What tinyxml2 makes of it, for all programs that read by it.
    pub(crate) document: Document<'a>,
    meshes: &'a dyn Fn(&str) -> Mesh,
}

impl<'a> File<'a> {
    /// A file as it is on disk. `meshes` says what is there of a mesh, by the name that the URDF gives it.
    pub fn new(bytes: &'a [u8], meshes: &'a dyn Fn(&str) -> Mesh) -> Self {
        File { bytes, document: Document::of(bytes), meshes }
    }

    pub(crate) fn mesh(&self, name: &str) -> Mesh {
        (self.meshes)(name)
    }
}
