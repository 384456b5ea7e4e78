//! The contents of a URDD: one file per module, the root metadata, and the registry of every
//! (module, version). Types and their schemas; no I/O.
//!
//! Each type is the source of its published JSON Schema, and accepts exactly what that schema
//! accepts: see [`object`].
//!
//! ```
//! use urdd_format::bounds::BoundsModule;
//! use urdd_format::registry::ModuleKind;
//!
//! let text = r#"{
//!     "bounds": [[-1.5, 2.0]], "dof_lower_bounds": [-1.5], "dof_upper_bounds": [2.0],
//!     "dof_limited": [true], "dof_velocity_limits": [null], "dof_effort_limits": [87.0]
//! }"#;
//! let module: BoundsModule = serde_json::from_str(text)?; // every key is required, unknown keys are refused
//! assert_eq!(module.bounds, [[-1.5, 2.0]]);
//! assert!(ModuleKind::Bounds.depends_on().contains(&ModuleKind::Dof));
//! # Ok::<(), serde_json::Error>(())
//! ```

#[doc(hidden)]
pub mod annotations;
pub mod bounds;
#[doc(hidden)]
pub mod bundle;
#[doc(hidden)]
pub mod carried;
pub mod chain;
#[doc(hidden)]
pub mod colors;
pub mod composition;
pub mod conformance;
pub mod connections;
pub mod convex_decomposition_meshes;
pub mod convex_hull_meshes;
pub mod diff_report;
pub mod dof;
#[doc(hidden)]
pub mod escape;
#[doc(hidden)]
pub mod hexadecimal;
pub mod index;
pub mod kinematics_samples;
pub mod legacy;
pub mod link_shapes_approximations;
pub mod link_shapes_distance_statistics;
pub mod link_shapes_simple_skips;
pub mod link_shapes_skips;
pub mod link_shapes_spheres;
pub mod loops;
pub mod meshes;
pub mod named_configurations;
#[doc(hidden)]
pub mod nearest;
#[doc(hidden)]
pub mod new_extension;
mod not_examined;
pub mod object;
pub mod original_meshes;
pub mod plain_meshes;
pub mod pose;
pub mod rate;
#[doc(hidden)]
pub mod readable;
pub mod registry;
pub mod report;
mod report_of_urdf;
pub mod root_metadata;
pub mod schema;
pub mod self_collision_model;
pub mod shape_kind;
pub mod shapes;
#[doc(hidden)]
pub mod short;
pub mod skips;
mod types;
pub mod urdf;
pub mod word;
