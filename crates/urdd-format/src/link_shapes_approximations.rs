//! `link_shapes_approximations_module`: oriented bounding boxes and bounding spheres of links and pieces.

use super::annotations::lengths;
use super::object::{module, object};

module! {
    /// Oriented bounding boxes (OBBs) and bounding spheres of each link and of each convex piece, in
    /// the link's frame.
    pub struct LinkShapesApproximationsModule {
        /// For each link, a box that holds its hull; null for a link without a mesh.
        #[schemars(transform = lengths("links"))]
        pub full_obbs: Vec<Option<Obb>>,
        /// For each link, a sphere that holds its hull; null for a link without a mesh.
        #[schemars(transform = lengths("links"))]
        pub full_bounding_spheres: Vec<Option<BoundingSphere>>,
        /// For each link, a box for each convex piece.
        #[schemars(transform = lengths("links, pieces"))]
        pub decomposition_obbs: Vec<Vec<Obb>>,
        /// For each link, a sphere for each convex piece.
        #[schemars(transform = lengths("links, pieces"))]
        pub decomposition_bounding_spheres: Vec<Vec<BoundingSphere>>,
    }
}

object! {
    /// An oriented bounding box.
    pub struct Obb {
        /// Half of each side length, metres, along the box's own axes.
        #[schemars(extend("x-unit" = "m", "x-frame" = "shape"))]
        pub half_extents: [f64; 3],
        /// Centre in the link's frame, metres.
        #[schemars(extend("x-unit" = "m", "x-frame" = "link"))]
        pub offset_xyz: [f64; 3],
        /// Rotation from the box's axes to the link's: fixed-axis roll, pitch, yaw, radians.
        #[schemars(extend("x-unit" = "rad", "x-frame" = "link"))]
        pub offset_rpy: [f64; 3],
    }
}

object! {
    /// A bounding sphere.
    pub struct BoundingSphere {
        /// Radius, metres.
        #[schemars(extend("x-unit" = "m"))]
        pub radius: f64,
        /// Centre in the link's frame, metres.
        #[schemars(extend("x-unit" = "m", "x-frame" = "link"))]
        pub offset_xyz: [f64; 3],
    }
}
