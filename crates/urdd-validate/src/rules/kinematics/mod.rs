//! KIN: poses.

mod poses_disagree;
mod sample_pose_wrong;
mod samples;

use crate::rule::rules;

rules! {
    poses_disagree, sample_pose_wrong, samples
}
