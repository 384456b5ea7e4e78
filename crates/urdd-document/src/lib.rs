//! Internal to urdd; no stability promise.
//!
//! A loaded URDD of any version: its files and modules as far as they are readable ([`urdd::Urdd`]), and views of them.
//! Legacy modules are raised to version 1 or have version-independent views.
//!
//! This crate only describes; `validate` judges.

pub mod consumer;
pub mod load;
pub mod meshes;
pub mod module;
pub mod paths;
pub mod pose;
pub mod robot;
pub mod schema_check;
pub mod shape_matrices;
pub mod shapes;
pub mod tree;
pub mod urdd;
pub mod usable_geometry;

// Parts of these, by names of their own.
pub use load as kept;
pub use module as carried_urdf;
pub use paths as mesh_files;
pub use robot as dof_layout;
pub use schema_check as legacy;
pub use tree as mechanism;
pub use urdd as entries;
