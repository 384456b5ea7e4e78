//! KIN: poses.

mod poses_disagree;
mod sample_configuration_wrong;
mod sample_list_wrong;
mod sample_pose_wrong;
mod samples_missing;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &poses_disagree::RULE,
    &sample_configuration_wrong::RULE,
    &sample_pose_wrong::RULE,
    &sample_list_wrong::RULE,
    &samples_missing::RULE,
];
