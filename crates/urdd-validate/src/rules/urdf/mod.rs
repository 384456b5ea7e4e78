//! URD: `urdf_module` against the carried URDF, and as a tree.

pub mod cycle;
pub mod differences;
mod mimics;
mod names;
pub mod parts;
mod tree;
mod unreadable_urdf;
pub mod zero_axis;

use crate::rule::rules;

rules! {
    cycle, differences, mimics, names, tree, unreadable_urdf, zero_axis
}
