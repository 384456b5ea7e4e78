//! SHP: the link shape modules, by themselves and held to the meshes and the kinematics.

mod asymmetric_matrix;
mod default_reason_wrong;
mod diagonal_wrong;
mod distance_out_of_range;
mod hull_distance_wrong;
mod impossible_shape_size;
mod matrix_size;
mod max_distance_wrong;
mod needlessly_large_box;
mod needlessly_large_sphere;
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

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &shape_list_length::RULE,
    &shape_presence_differs::RULE,
    &impossible_shape_size::RULE,
    &max_distance_wrong::RULE,
    &matrix_size::RULE,
    &asymmetric_matrix::RULE,
    &diagonal_wrong::RULE,
    &statistics_out_of_order::RULE,
    &negative_distance::RULE,
    &shape_list_differs::RULE,
    &simple_skip_wrong::RULE,
    &skip_reason_wrong::RULE,
    &skips_not_from_edits::RULE,
    &unknown_link_in_edit::RULE,
    &piece_matrix_missing::RULE,
    &no_samples::RULE,
    &shape_leaves_out_part::RULE,
    &shape_does_not_touch::RULE,
    &needlessly_large_box::RULE,
    &needlessly_large_sphere::RULE,
    &hull_distance_wrong::RULE,
    &rigid_pair_not_constant::RULE,
    &distance_out_of_range::RULE,
    &statistics_differ::RULE,
    &skipped_pair_moves_apart::RULE,
    &default_reason_wrong::RULE,
    &skipped_reasons_disordered::RULE,
];
