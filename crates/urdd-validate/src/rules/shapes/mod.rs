//! SHP: the link shape modules, on their own and compared with meshes and kinematics.

mod asymmetric_matrix;
mod default_reason_wrong;
mod distance_out_of_range;
mod edits;
mod fit;
mod hull_distance_wrong;
mod lists;
mod matrices;
mod max_distance_wrong;
pub mod needlessly_large;
mod simple_skip_wrong;
mod skip_reason_wrong;
mod skipped_pair_moves_apart;
mod statistics;
mod statistics_differ;

use crate::rule::rules;

rules! {
    asymmetric_matrix, default_reason_wrong, distance_out_of_range, edits, fit,
    hull_distance_wrong, lists, matrices, max_distance_wrong, needlessly_large, simple_skip_wrong,
    skip_reason_wrong, skipped_pair_moves_apart, statistics, statistics_differ
}
