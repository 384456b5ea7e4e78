//! URD: `urdf_module` against the carried URDF, and as a tree.

pub mod compared;
pub mod joints;
pub mod tree;

use crate::rule::rules;

rules! {
    compared, joints, tree
}
