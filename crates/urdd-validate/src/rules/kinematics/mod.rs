//! KIN: poses.

mod poses_disagree;
mod sample_configuration_wrong;
mod sample_list_wrong;
mod sample_pose_wrong;
mod samples_missing;

use crate::rule::rules;

rules! {
    poses_disagree, sample_configuration_wrong, sample_list_wrong, sample_pose_wrong,
    samples_missing
}
