//! SHP: the link shape modules, by themselves and held to the meshes and the kinematics.

pub mod asymmetric_matrix;
pub mod default_reason_wrong;
pub mod diagonal_wrong;
pub mod distance_out_of_range;
pub mod hull_distance_wrong;
pub mod impossible_shape_size;
pub mod matrix_size;
pub mod max_distance_wrong;
pub mod needlessly_large_box;
pub mod needlessly_large_sphere;
pub mod negative_distance;
pub mod no_samples;
pub mod piece_matrix_missing;
pub mod rigid_pair_not_constant;
pub mod shape_does_not_touch;
pub mod shape_leaves_out_part;
pub mod shape_list_differs;
pub mod shape_list_length;
pub mod shape_presence_differs;
pub mod simple_skip_wrong;
pub mod skip_reason_wrong;
pub mod skipped_pair_moves_apart;
pub mod skipped_reasons_disordered;
pub mod skips_not_from_edits;
pub mod statistics_differ;
pub mod statistics_out_of_order;
pub mod unknown_link_in_edit;

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
