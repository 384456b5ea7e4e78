//! The mesh modules, and types shared by them. `original_meshes_module`: unmodified copies of the mesh files that the URDF
//! names. `plain_meshes_module`: one mesh per link, in the link's frame. `convex_hull_meshes_module`: the convex hull of each
//! link. `convex_decomposition_meshes_module`: each link as a union of convex pieces.

use crate::index::{ElementIdx, LinkIdx};
use crate::types::{module, types};

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

module! {
    /// One mesh per link: all its geometry of one kind, with origin, rotation and scale applied and
    /// primitives tessellated.
    pub struct PlainMeshesModule {
        /// Which geometry is preferred; the other is used for a link that has none of it.
        pub preferred_geometry: GeometryKind,
        /// For each link its mesh, or null for a link without geometry.
        pub link_meshes: Vec<Option<PlainMesh>> where { length: "links" },
    }

    /// The mesh of a link.
    pub struct PlainMesh {
        /// Which geometry it was made from.
        pub geometry: GeometryKind,
        /// Its files.
        pub files: MeshFiles,
    }
}

module! {
    /// The convex hull of each link's plain mesh.
    pub struct ConvexHullMeshesModule {
        /// For each link its hull, or null for a link without a plain mesh.
        pub link_hulls: Vec<Option<MeshFiles>> where { length: "links" },
    }
}

module! {
    /// Each link's plain mesh as a union of convex pieces.
    pub struct ConvexDecompositionMeshesModule {
        /// How the pieces were made. Any method may be used, as long as `surface_tolerance` holds (7.10).
        pub method: DecompositionMethod,
        /// For each link its pieces; empty for a link without a plain mesh. The place in the list is
        /// the piece index.
        pub link_pieces: Vec<Vec<MeshFiles>> where { length: "links, pieces" },
    }

    /// How convex pieces were made.
    pub struct DecompositionMethod {
        /// Name of the algorithm.
        pub name: String,
        /// How far a point of the link's surface may lie outside the pieces, metres, where the
        /// algorithm promises that; else null.
        pub surface_tolerance: Option<f64> where { unit: "m" },
    }
}
