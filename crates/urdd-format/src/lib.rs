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
pub mod composition;
pub mod conformance;
pub mod diff_report;
#[doc(hidden)]
pub mod escape;
pub mod index;
pub mod legacy;
pub mod link_shapes_approximations;
pub mod link_shapes_skips;
pub mod link_shapes_spheres;
pub mod loops;
pub mod meshes;
pub mod named_configurations;
pub mod object;
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
mod types;
pub mod urdf;
pub mod word;

// Parts of these, by names of their own.
#[doc(hidden)]
pub use annotations as new_extension;
pub use chain::{self as connections, self as dof, self as kinematics_samples, self as pose};
#[doc(hidden)]
pub use escape as short;
pub use link_shapes_approximations::{self as link_shapes_distance_statistics, self as shapes};
pub use link_shapes_skips::{self as link_shapes_simple_skips, self as skips};
pub use meshes::{
    self as convex_decomposition_meshes, self as convex_hull_meshes, self as original_meshes,
    self as plain_meshes,
};
#[doc(hidden)]
pub use readable as hexadecimal;
#[doc(hidden)]
pub use urdf as colors;
#[doc(hidden)]
pub use word as nearest;
