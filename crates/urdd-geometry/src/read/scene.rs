//! What the readers return.

use std::sync::Arc;

use super::error::Note;
use super::format::Format;
use crate::mesh::Mesh;

/// The content of a mesh file with all placements applied, in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The detected format of the content.
    pub format: Format,
    /// One part per material, in the order of first use. Empty without triangles.
    pub parts: Vec<Part>,
    /// Files that the mesh references (.mtl, .bin, textures), relative to it, sorted, including missing ones.
    pub side_files: Vec<String>,
    /// Assumptions, repairs and omissions.
    pub notes: Vec<Note>,
}

/// Triangles of one material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// The triangles, in the axes of the URDF's mesh element.
    pub mesh: Mesh,
    /// Red, green, blue and opacity, each from 0 to 1; `None` if the file gives no colour or uses a texture.
    pub color: Option<[f64; 4]>,
    /// The material's name.
    pub material: Option<String>,
    /// Its texture; always `None` without [`Options::textures`](super::Options::textures).
    pub texture: Option<Texture>,
}

/// An image on a part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Texture {
    /// The image's file, as the mesh names it; of an embedded image, what stands for its name.
    pub name: String,
    /// The content of an embedded image.
    pub embedded: Option<Arc<[u8]>>,
    /// Places in the image, one for each vertex of the mesh: (0, 0) is lower left, (1, 1) upper right, and the image
    /// repeats. Empty if the mesh has none.
    pub uv: Vec<[f64; 2]>,
}

impl Scene {
    /// All parts merged into one mesh, in order.
    #[must_use]
    pub fn merged(&self) -> Mesh {
        let mut mesh = Mesh::default();
        for part in &self.parts {
            mesh.append(&part.mesh);
        }
        mesh
    }

    /// Number of triangles in all parts.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.parts.iter().map(|part| part.mesh.triangles.len()).sum()
    }
}
