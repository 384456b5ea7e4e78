//! SHP: the link shape modules. What the shapes themselves are like is not looked at here.

pub mod asymmetric_matrix;
pub mod diagonal_wrong;
pub mod impossible_shape_size;
pub mod matrix_size;
pub mod max_distance_wrong;
pub mod negative_distance;
pub mod no_samples;
pub mod piece_matrix_missing;
pub mod shape_list_differs;
pub mod shape_list_length;
pub mod shape_presence_differs;
pub mod simple_skip_wrong;
pub mod skip_reason_wrong;
pub mod skips_not_from_edits;
pub mod statistics_out_of_order;
pub mod unknown_link_in_edit;

use crate::validate::rule::Rule;

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
];
