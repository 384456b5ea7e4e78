//! SHP: the link shape modules, on their own and compared with meshes and kinematics.

mod asymmetric_matrix;
mod default_reason_wrong;
mod diagonal_wrong;
mod distance_out_of_range;
mod hull_distance_wrong;
mod impossible_shape_size;
mod matrix_size;
mod max_distance_wrong;
mod needlessly_large;
mod needlessly_large_box;
pub mod needlessly_large_sphere;
mod negative_distance;
mod no_samples;
mod piece_matrix_missing;
mod rigid_pair_not_constant;
mod shape_does_not_touch;
mod shape_leaves_out_part;
mod shape_list_differs;
mod shape_list_length;
mod shape_presence_differs;
mod simple_skip_wrong;
mod skip_reason_wrong;
mod skipped_pair_moves_apart;
mod skipped_reasons_disordered;
mod skips_not_from_edits;
mod statistics_differ;
mod statistics_out_of_order;
mod unknown_link_in_edit;

use crate::rule::rules;

rules! {
    asymmetric_matrix, default_reason_wrong, diagonal_wrong, distance_out_of_range,
    hull_distance_wrong, impossible_shape_size, matrix_size, max_distance_wrong,
    needlessly_large_box, needlessly_large_sphere, negative_distance, no_samples,
    piece_matrix_missing, rigid_pair_not_constant, shape_does_not_touch, shape_leaves_out_part,
    shape_list_differs, shape_list_length, shape_presence_differs, simple_skip_wrong,
    skip_reason_wrong, skipped_pair_moves_apart, skipped_reasons_disordered,
    skips_not_from_edits, statistics_differ, statistics_out_of_order, unknown_link_in_edit
}
