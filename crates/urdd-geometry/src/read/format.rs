//! The mesh formats.

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
    pub(super) fn label(self) -> &'static str {
        match self {
            Self::StlBinary | Self::StlAscii => "STL",
            Self::Collada => "COLLADA",
            Self::Obj => "OBJ",
            Self::Gltf => "glTF",
            Self::Glb => "GLB",
        }
    }

    /// The file extension of this format, without the dot.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::StlBinary | Self::StlAscii => "stl",
            Self::Collada => "dae",
            Self::Obj => "obj",
            Self::Gltf => "gltf",
            Self::Glb => "glb",
        }
    }
}
