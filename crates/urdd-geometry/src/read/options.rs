//! Options of the readers.

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
