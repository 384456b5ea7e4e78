//! Internal to urdd; no stability promise.
//!
//! Mesh input and output, and geometry computed from meshes. This crate does not know the URDD format.
//!
//! - [`mesh`] is the triangle mesh that all modules share; it rounds, welds and filters itself.
//! - [`read`] reads STL, COLLADA, OBJ and glTF; [`write`](mod@write) writes STL, OBJ and GLB.
//! - [`primitives`] tessellates box, cylinder, sphere and capsule.
//! - [`hull`] computes convex hulls. [`oriented_box`] and [`bounding_sphere`] fit minimum-volume boxes and spheres.
//!   [`enclosing`] puts boxes, cylinders, capsules and spheres around a hull.
//!   [`decompose`](mod@decompose) splits a mesh into convex pieces.
//! - [`surface`] compares two meshes, whatever the order of their triangles.
//! - [`farthest`] measures the extent from the origin. [`convex`] measures distances between convex shapes, and
//!   [`half_spaces`] those of points from the planes of a body's faces.

pub mod bounding_sphere;
pub mod convex;
pub mod decompose;
pub mod enclosing;
pub mod farthest;
pub mod half_spaces;
pub mod hull;
mod lanes;
#[cfg(test)]
#[path = "tests/levels.rs"]
mod levels;
pub mod mesh;
pub mod oriented_box;
mod polygon;
pub mod primitives;
pub mod read;
pub mod surface;
pub mod vector;
pub mod write;

pub use mesh::Mesh;
