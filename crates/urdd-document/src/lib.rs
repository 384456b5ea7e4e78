//! A URDD of any version, loaded, in one shape: files and modules as far as they could be read
//! ([`urdd::Urdd`]), and views of them that version 1 and legacy modules share. Where a field has
//! the same name in both, its pointer is the same too.
//!
//! What is here describes; what is right or wrong is for `validate` to say.

pub mod bounds;
pub mod carried_urdf;
pub mod chain;
pub mod connections;
pub mod consumer;
pub mod dof_layout;
pub mod dofs;
pub mod draft;
pub mod entries;
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
