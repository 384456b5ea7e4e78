//! `link_shapes_approximations_module`: oriented bounding boxes and bounding spheres of links and pieces, and
//! `link_shapes_max_distance_from_origin_module`: maximum distance of shapes from their link's origin.

use super::types::module;

module! {
    /// Oriented bounding boxes (OBBs) and bounding spheres of each link and of each convex piece, in
    /// the link's frame.
    pub struct LinkShapesApproximationsModule {
        /// For each link, a box that holds its hull; null for a link without a mesh.
        pub full_obbs: Vec<Option<Obb>> where { length: "links" },
        /// For each link, a sphere that holds its hull; null for a link without a mesh.
        pub full_bounding_spheres: Vec<Option<BoundingSphere>> where { length: "links" },
        /// For each link, a box for each convex piece.
        pub decomposition_obbs: Vec<Vec<Obb>> where { length: "links, pieces" },
        /// For each link, a sphere for each convex piece.
        pub decomposition_bounding_spheres: Vec<Vec<BoundingSphere>> where { length: "links, pieces" },
    }

    /// An oriented bounding box.
    pub struct Obb {
        /// Half of each side length, metres, along the box's own axes.
        pub half_extents: [f64; 3] where { unit: "m", frame: "shape" },
        /// Centre in the link's frame, metres.
        pub offset_xyz: [f64; 3] where { unit: "m", frame: "link" },
        /// Rotation from the box's axes to the link's: fixed-axis roll, pitch, yaw, radians.
        pub offset_rpy: [f64; 3] where { unit: "rad", frame: "link" },
    }

    /// A bounding sphere.
    pub struct BoundingSphere {
        /// Radius, metres.
        pub radius: f64 where { unit: "m" },
        /// Centre in the link's frame, metres.
        pub offset_xyz: [f64; 3] where { unit: "m", frame: "link" },
    }
}

module! {
    /// The largest distance of any point of a shape from the origin of its link's frame, metres.
    pub struct LinkShapesMaxDistanceFromOriginModule {
        /// For each link, of its convex hull; null for a link without one.
        pub full_convex_hulls_maximum_distances: Vec<Option<f64>> where { unit: "m", length: "links" },
        /// For each link, of its box; null for a link without one.
        pub full_obbs_maximum_distances: Vec<Option<f64>> where { unit: "m", length: "links" },
        /// For each link, of its sphere; null for a link without one.
        pub full_bounding_spheres_maximum_distances: Vec<Option<f64>> where { unit: "m", length: "links" },
        /// For each link, of each convex piece.
        pub decomposition_convex_hulls_maximum_distances: Vec<Vec<f64>> where { unit: "m", length: "links, pieces" },
        /// For each link, of the box of each convex piece.
        pub decomposition_obbs_maximum_distances: Vec<Vec<f64>> where { unit: "m", length: "links, pieces" },
        /// For each link, of the sphere of each convex piece.
        pub decomposition_bounding_spheres_maximum_distances: Vec<Vec<f64>> where { unit: "m", length: "links, pieces" },
    }
}
