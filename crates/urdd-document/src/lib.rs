//! Internal to urdd; no stability promise.
//!
//! A loaded URDD of any version: its files and modules as far as they are readable ([`urdd::Urdd`]), and
//! version-independent views. Fields with the same name in both versions have the same pointer.
//!
//! This crate only describes; `validate` judges.

pub mod bounds;
pub mod carried_urdf;
pub mod chain;
pub mod connections;
pub mod consumer;
pub mod dof_layout;
pub mod dofs;
pub mod draft;
pub mod entries;
pub mod kept;
pub mod legacy_urdf;
pub mod load;
pub mod mesh_files;
pub mod meshes;
pub mod mimics;
pub mod module;
pub mod paths;
pub mod pose;
pub mod rigid_groups;
pub mod robot;
pub mod schema_check;
pub mod shape_matrices;
pub mod shapes;
pub mod tree;
pub mod urdd;
pub mod usable_geometry;
