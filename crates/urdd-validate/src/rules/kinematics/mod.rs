//! KIN: poses.

mod poses_disagree;
mod sample_configuration_wrong;
mod sample_list;
mod sample_pose_wrong;

use crate::rule::rules;

rules! {
    poses_disagree, sample_configuration_wrong, sample_list, sample_pose_wrong
}
