//! KIN: poses.

pub mod poses_disagree;
pub mod sample_configuration_wrong;
pub mod sample_list_wrong;
pub mod sample_pose_wrong;
pub mod samples_missing;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &poses_disagree::RULE,
    &sample_configuration_wrong::RULE,
    &sample_pose_wrong::RULE,
    &sample_list_wrong::RULE,
    &samples_missing::RULE,
];
