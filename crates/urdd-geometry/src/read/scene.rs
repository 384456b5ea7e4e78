//! What the readers are asked for, and what they return.

use std::sync::Arc;

use super::error::Note;
use crate::mesh::Mesh;

/// A mesh format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Binary STL.
    StlBinary,
    /// STL as text.
    StlAscii,
    /// COLLADA (.dae).
    Collada,
    /// Wavefront OBJ.
    Obj,
    /// glTF as JSON.
    Gltf,
    /// Binary glTF.
    Glb,
}

impl Format {
    /// Its file extension, and its name.
    fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::StlBinary | Self::StlAscii => ("stl", "STL"),
            Self::Collada => ("dae", "COLLADA"),
            Self::Obj => ("obj", "OBJ"),
            Self::Gltf => ("gltf", "glTF"),
            Self::Glb => ("glb", "GLB"),
        }
    }

    /// The file extension of this format, without the dot.
    pub fn extension(self) -> &'static str {
        self.names().0
    }

    pub(super) fn label(self) -> &'static str {
        self.names().1
    }
}

/// How to treat the y-up axes of glTF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GltfUp {
    /// Rotate by +90 degrees about x: (x, y, z) becomes (x, -z, y).
    #[default]
    Turn,
    /// Keep the file's axes.
    Keep,
}

/// Reader options.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Treatment of the glTF axes.
    pub gltf_up: GltfUp,
    /// Maximum number of triangles; a file with more is an error.
    pub max_triangles: usize,
    /// Whether to leave the faces that are not convex uncut. Each is then a fan from its first corner, which may overlap
    /// itself, between two triangles of three equal indices. No other triangle has three equal indices.
    pub uncut: bool,
    /// Whether to read textures. Vertices then have one texture coordinate each: one where a texture is cut is several.
    pub textures: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { gltf_up: GltfUp::Turn, max_triangles: 20_000_000, uncut: false, textures: false }
    }
}

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
    /// Its texture; always `None` without [`Options::textures`].
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
    pub fn merged(&self) -> Mesh {
        let mut mesh = Mesh::default();
        for part in &self.parts {
            mesh.append(&part.mesh);
        }
        mesh
    }

    /// Number of triangles in all parts.
    pub fn triangle_count(&self) -> usize {
        self.parts.iter().map(|part| part.mesh.triangles.len()).sum()
    }
}
