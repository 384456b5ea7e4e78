//! URD: `urdf_module` against the carried URDF, and as a tree.

pub mod cycle;
pub mod duplicate_joint_name;
pub mod duplicate_link_name;
pub mod joints_not_the_urdfs;
pub mod links_not_the_urdfs;
pub mod materials_not_the_urdfs;
pub mod mimic_circle;
pub mod mimic_of_many_dofs;
pub mod not_one_root;
mod parts;
mod source_differences;
pub mod two_parents;
pub mod unknown_link;
pub mod unknown_mimic_driver;
pub mod unreadable_urdf;
pub mod zero_axis;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &joints_not_the_urdfs::RULE,
    &duplicate_link_name::RULE,
    &duplicate_joint_name::RULE,
    &not_one_root::RULE,
    &two_parents::RULE,
    &cycle::RULE,
    &unknown_link::RULE,
    &unknown_mimic_driver::RULE,
    &mimic_circle::RULE,
    &zero_axis::RULE,
    &unreadable_urdf::RULE,
    &mimic_of_many_dofs::RULE,
    &links_not_the_urdfs::RULE,
    &materials_not_the_urdfs::RULE,
];
