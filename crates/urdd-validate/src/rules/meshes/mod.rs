//! MSH: the mesh modules and the contents of their files.

mod carried_files_mismatch;
mod convexity;
mod glb_not_binary;
mod hull_and_mesh;
mod hull_leaves_out_mesh;
mod hull_not_convex;
mod hull_vertex_off_mesh;
mod link_without_mesh;
mod mesh_file_missing;
pub mod mesh_file_name;
mod mesh_file_shared;
mod mesh_format_mismatch;
mod mesh_formats_differ;
mod mesh_list_length;
mod mesh_misplaced;
mod mesh_presence_differs;
mod mesh_references_differ;
mod mesh_unsound;
mod modules;
mod original_misdescribed;
mod outreach;
mod piece_barely_leaves_hull;
pub mod piece_count_mismatch;
mod piece_leaves_hull;
mod piece_not_convex;
mod pieces_leave_surface;
mod wrong_geometry_used;

use crate::rule::rules;
use modules::MODULES;

rules! {
    carried_files_mismatch, glb_not_binary, hull_leaves_out_mesh, hull_not_convex,
    hull_vertex_off_mesh, link_without_mesh, mesh_file_missing, mesh_file_name,
    mesh_file_shared, mesh_format_mismatch, mesh_formats_differ, mesh_list_length,
    mesh_misplaced, mesh_presence_differs, mesh_references_differ, mesh_unsound,
    original_misdescribed, piece_barely_leaves_hull, piece_count_mismatch, piece_leaves_hull,
    piece_not_convex, pieces_leave_surface, wrong_geometry_used
}
