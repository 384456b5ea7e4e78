//! CHN: `chain_module`.
//!
//! Every table is compared with the tree that follows from `urdf_module`, and none with another, so
//! that one wrong value gives one finding.

mod joint_origin_differs;
mod joints;
mod links;
pub mod quaternion_not_canonical;

use crate::rule::rules;

rules! {
    joint_origin_differs, joints, links, quaternion_not_canonical
}
