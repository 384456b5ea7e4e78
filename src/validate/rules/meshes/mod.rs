//! MSH: the mesh modules. What the meshes themselves are like is not looked at here.

pub mod carried_files_mismatch;
pub mod glb_not_binary;
pub mod link_without_mesh;
pub mod mesh_file_missing;
pub mod mesh_file_name;
pub mod mesh_file_shared;
pub mod mesh_format_mismatch;
pub mod mesh_list_length;
pub mod mesh_presence_differs;
pub mod mesh_references_differ;
pub mod piece_count_mismatch;
pub mod wrong_geometry_used;

use crate::validate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &mesh_list_length::RULE,
    &mesh_file_missing::RULE,
    &mesh_format_mismatch::RULE,
    &piece_count_mismatch::RULE,
    &mesh_file_shared::RULE,
    &mesh_file_name::RULE,
    &mesh_presence_differs::RULE,
    &wrong_geometry_used::RULE,
    &mesh_references_differ::RULE,
    &glb_not_binary::RULE,
    &link_without_mesh::RULE,
    &carried_files_mismatch::RULE,
];
