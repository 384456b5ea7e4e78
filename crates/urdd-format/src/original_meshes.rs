//! `original_meshes_module`: unmodified copies of the mesh files that the URDF names.

use super::index::{ElementIdx, LinkIdx};
use super::meshes::GeometryKind;
use super::types::module;

module! {
    /// Every mesh that the URDF names, carried unchanged.
    pub struct OriginalMeshesModule {
        /// Every mesh reference of the URDF: links in order, visual before collision, elements in order.
        pub references: Vec<MeshReference>,
        /// Every carried mesh file once, sorted by path (byte order).
        pub files: Vec<OriginalMesh>,
    }

    /// A place in the URDF that names a mesh.
    pub struct MeshReference {
        /// The link.
        pub link_idx: LinkIdx,
        /// Whether a visual or a collision element names it.
        pub geometry: GeometryKind,
        /// Which of the link's elements of that kind.
        pub element_idx: ElementIdx,
        /// File name as the URDF has it.
        pub filename: String,
        /// The carried file, relative to the URDD's root; null where the mesh could not be found.
        pub path: Option<String>,
    }

    /// A carried mesh file.
    pub struct OriginalMesh {
        /// Path relative to the URDD's root, with forward slashes.
        pub path: String,
        /// Files that the mesh names in turn (`.mtl`, `.bin`, textures), relative to the URDD's root,
        /// sorted. They lie where the mesh expects them.
        pub side_files: Vec<String>,
        /// Whether the file can be read as a mesh, and has a triangle with an area. Where not, elements
        /// that name it have no surface.
        pub usable: bool,
    }
}
