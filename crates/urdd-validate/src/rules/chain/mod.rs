//! CHN: `chain_module`.
//!
//! Every table is compared with the tree that follows from `urdf_module`, and none with another, so
//! that one wrong value gives one finding.

pub mod joints;
mod links;

use crate::rule::rules;

rules! {
    joints, links
}
