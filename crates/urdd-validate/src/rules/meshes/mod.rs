//! MSH: the mesh modules, and what their files hold.

mod carried_files_mismatch;
mod convexity;
mod glb_not_binary;
mod hull_leaves_out_mesh;
mod hull_not_convex;
mod hull_vertex_off_mesh;
mod link_without_mesh;
mod mesh_file_missing;
mod mesh_file_name;
mod mesh_file_shared;
mod mesh_format_mismatch;
mod mesh_formats_differ;
mod mesh_list_length;
mod mesh_misplaced;
mod mesh_presence_differs;
mod mesh_references_differ;
mod mesh_unsound;
mod original_misdescribed;
mod outreach;
mod piece_barely_leaves_hull;
mod piece_count_mismatch;
mod piece_leaves_hull;
mod piece_not_convex;
mod pieces_leave_surface;
mod wrong_geometry_used;

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
