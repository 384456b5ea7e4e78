//! MSH: the mesh modules, and what their files hold.

pub mod carried_files_mismatch;
mod convexity;
pub mod glb_not_binary;
pub mod hull_leaves_out_mesh;
pub mod hull_not_convex;
pub mod hull_vertex_off_mesh;
pub mod link_without_mesh;
pub mod mesh_file_missing;
pub mod mesh_file_name;
pub mod mesh_file_shared;
pub mod mesh_format_mismatch;
pub mod mesh_formats_differ;
pub mod mesh_list_length;
pub mod mesh_misplaced;
pub mod mesh_presence_differs;
pub mod mesh_references_differ;
pub mod mesh_unsound;
pub mod original_misdescribed;
mod outreach;
pub mod piece_barely_leaves_hull;
pub mod piece_count_mismatch;
pub mod piece_leaves_hull;
pub mod piece_not_convex;
pub mod pieces_leave_surface;
pub mod wrong_geometry_used;

use crate::rule::Rule;

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
    &mesh_unsound::RULE,
    &mesh_formats_differ::RULE,
    &mesh_misplaced::RULE,
    &original_misdescribed::RULE,
    &hull_not_convex::RULE,
    &hull_leaves_out_mesh::RULE,
    &hull_vertex_off_mesh::RULE,
    &piece_not_convex::RULE,
    &piece_leaves_hull::RULE,
    &pieces_leave_surface::RULE,
    &piece_barely_leaves_hull::RULE,
];
