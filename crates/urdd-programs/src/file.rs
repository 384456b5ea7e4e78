//! What a reader is asked about.

use crate::mesh::Mesh;

/// A URDF, and the mesh files that it names.
pub struct File<'a> {
    /// The file as it is on disk.
    pub bytes: &'a [u8],
    /// What is there of a mesh, by the name that the URDF gives it.
    pub meshes: &'a dyn Fn(&str) -> Mesh,
}

impl File<'_> {
    pub(crate) fn mesh(&self, name: &str) -> Mesh {
        (self.meshes)(name)
    }
}
