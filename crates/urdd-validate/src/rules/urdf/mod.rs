//! URD: `urdf_module` against the carried URDF, and as a tree.

pub mod compared;
pub mod joints;
mod names;
pub mod tree;
mod unreadable_urdf;

use crate::rule::rules;

rules! {
    compared, joints, names, tree, unreadable_urdf
}
