//! The contents of a URDD: one file per module, the root metadata, and the registry of every
//! (module, version). Types and their schemas; no I/O.
//!
//! Each type is the source of its published JSON Schema, and accepts exactly what that schema
//! accepts: see [`object`].

pub mod bounds;
pub mod bundle;
pub mod chain;
pub mod composition;
pub mod conformance;
pub mod connections;
pub mod convex_decomposition_meshes;
pub mod convex_hull_meshes;
pub mod dof;
pub mod escape;
pub mod hexadecimal;
pub mod index;
pub mod kinematics_samples;
pub mod legacy;
pub mod link_shapes_approximations;
pub mod link_shapes_distance_statistics;
pub mod link_shapes_max_distance_from_origin;
pub mod link_shapes_simple_skips;
pub mod link_shapes_skips;
pub mod meshes;
pub mod nearest;
pub mod object;
pub mod original_meshes;
pub mod plain_meshes;
pub mod pose;
pub mod rate;
pub mod readable;
pub mod registry;
pub mod report;
pub mod root_metadata;
pub mod schema;
pub mod self_collision_model;
pub mod shapes;
pub mod skips;
pub mod tagged;
pub mod urdf;
