//! CHN: `chain_module`.
//!
//! Every table is compared with the tree that follows from `urdf_module`, and none with another, so
//! that one wrong value gives one finding.

mod chain_joint_wrong;
mod chain_link_wrong;
mod children_wrong;
mod hierarchy_wrong;
mod joint_axis_wrong;
mod joint_origin_differs;
mod joint_type_differs;
mod list;
mod parent_wrong;
pub mod quaternion_not_canonical;
mod root_wrong;

use crate::rule::rules;
use list::list;

rules! {
    chain_joint_wrong, chain_link_wrong, children_wrong, hierarchy_wrong, joint_axis_wrong,
    joint_origin_differs, joint_type_differs, parent_wrong, quaternion_not_canonical, root_wrong
}
