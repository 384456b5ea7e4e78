//! MSH: the mesh modules and the contents of their files.

mod carried_files_mismatch;
mod convexity;
mod glb_not_binary;
mod hull_of_mesh;
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
pub mod piece_count_mismatch;
mod pieces_leave_surface;
mod wrong_geometry_used;

use crate::rule::rules;
use modules::MODULES;

rules! {
    carried_files_mismatch, convexity, glb_not_binary, hull_of_mesh, link_without_mesh,
    mesh_file_missing, mesh_file_name, mesh_file_shared, mesh_format_mismatch,
    mesh_formats_differ, mesh_list_length, mesh_misplaced, mesh_presence_differs,
    mesh_references_differ, mesh_unsound, original_misdescribed, outreach, piece_count_mismatch,
    pieces_leave_surface, wrong_geometry_used
}
