//! SHP: the link shape modules, on their own and compared with meshes and kinematics.

mod asymmetric_matrix;
mod fit;
mod lists;
mod matrices;
pub mod needlessly_large;
mod reaches;
mod reasons;
mod sampled;
mod skipped_pair_moves_apart;
mod skips;
mod statistics;

use crate::rule::rules;

rules! {
    asymmetric_matrix, fit, lists, matrices, needlessly_large, reaches, reasons, sampled,
    skipped_pair_moves_apart, skips, statistics
}
