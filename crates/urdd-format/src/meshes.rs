//! Types shared by the mesh modules.

use super::types::types;

types! {
    /// Which of a link's two geometries a mesh was made from.
    pub enum GeometryKind {
        /// The `visual` elements.
        Visual,
        /// The `collision` elements.
        Collision,
    }

    /// One mesh in up to three formats, the same triangles in each: vertices in metres, in the link's
    /// frame, binary32. Paths are relative to the URDD's root, with forward slashes.
    pub struct MeshFiles {
        /// Binary STL; null where the module has none.
        pub stl: Option<String>,
        /// Wavefront OBJ; null where the module has none.
        pub obj: Option<String>,
        /// Binary glTF 2.0, no node with a transform, vertices in link axes, with the source's colours.
        pub glb: String,
    }
}
