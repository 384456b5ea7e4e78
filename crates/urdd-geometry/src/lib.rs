//! Meshes in and out, and what is computed from them. Knows no URDD.
//!
//! - [`mesh`] is the triangle mesh that everything here works on, [`clean`] puts one in order.
//! - [`read`] reads STL, COLLADA, OBJ and glTF; [`write`](mod@write) writes STL, OBJ and GLB.
//! - [`primitives`] tessellates box, cylinder, sphere and capsule.
//! - [`hull`] finds convex hulls, [`oriented_box`] and [`bounding_sphere`] the smallest boxes and spheres,
//!   [`decompose`](mod@decompose) convex pieces.
//! - [`farthest`] and [`convex`] measure distances from the origin and between convex shapes.

pub mod bounding_sphere;
pub mod clean;
pub mod convex;
pub mod decompose;
pub mod farthest;
pub mod hull;
pub mod levels;
pub mod mesh;
pub mod oriented_box;
mod polygon;
pub mod primitives;
pub mod read;
pub mod write;

pub use mesh::Mesh;
