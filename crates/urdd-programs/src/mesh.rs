//! What programs look at in a mesh file.

use std::sync::Arc;

/// A mesh file that a URDF names.
#[derive(Debug, Clone)]
pub enum Mesh {
    /// Not known: its package is not here. It is taken to be right.
    Unknown,
    /// There is no such file.
    Missing,
    /// It is there.
    Found(Arc<MeshFacts>),
}

/// What is in a mesh file.
#[derive(Debug, Clone, Default)]
pub struct MeshFacts {
    /// Its first bytes, at most 84.
    pub head: Vec<u8>,
    /// Its size, bytes.
    pub size: usize,
    /// How many triangles the file has, by its format's rules; 0 also if it cannot be read.
    pub triangles: usize,
    /// How many different vertices the triangles have.
    pub vertices: usize,
}

impl MeshFacts {
    /// Whether it is as long as a binary STL file of its number of triangles.
    pub fn is_binary_stl(&self) -> bool {
        let count = self.head.get(80..84).and_then(|bytes| bytes.try_into().ok());
        count.is_some_and(|count| u32::from_le_bytes(count) as usize * 50 + 84 == self.size)
    }
}
