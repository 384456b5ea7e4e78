//! Internal to urdd; no stability promise.
//!
//! A loaded URDD of any version: its files and modules as far as they are readable ([`urdd::Urdd`]), and views of them.
//! Legacy modules are raised to version 1 or have version-independent views.
//!
//! This crate only describes; `validate` judges.

pub mod carried_urdf;
pub mod consumer;
pub mod dof_layout;
pub mod entries;
pub mod kept;
pub mod legacy;
pub mod load;
pub mod mechanism;
pub mod mesh_files;
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
