//! CMP: how a robot was put together from others.

mod attachment_wrong;
mod frozen_joint_moves;
mod index_out_of_range;
mod not_one_to_one;
mod part_ids;
mod renamed_otherwise;

use crate::rule::rules;

rules! {
    attachment_wrong, frozen_joint_moves, index_out_of_range, not_one_to_one, part_ids,
    renamed_otherwise
}
