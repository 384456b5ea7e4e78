//! Module versions published before the specification, as their converter wrote them. They are
//! frozen: faults are documented, not corrected.
//!
//! Common to all: lengths in metres, angles in radians; rotations as fixed-axis roll, pitch, yaw. A
//! *shape index* counts the links that have a mesh, in link order, or their convex pieces, in link
//! order then piece order. Mesh paths start with a robot's folder name and are relative to the
//! folder above the URDD, which also contains the parts of a composed robot.
//!
//! `link_shapes_max_distance_from_origin_module` 0.0.3 has the structure of version 1.0.0.

pub mod adjusted_robot;
pub mod bounds;
pub mod chain;
pub mod combined_robot;
pub mod connections;
pub mod convex_decomposition_meshes;
pub mod convex_hull_meshes;
pub mod creator;
pub mod dof;
pub mod first_look_vis;
pub mod link_shapes_approximations;
pub mod link_shapes_distance_statistics;
pub mod link_shapes_lie_alg_error_models;
pub mod link_shapes_simple_skips;
pub mod link_shapes_skips;
pub mod original_meshes;
pub mod plain_meshes;
pub mod urdf;
