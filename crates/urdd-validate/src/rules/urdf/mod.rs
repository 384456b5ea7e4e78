//! URD: `urdf_module` against the carried URDF, and as a tree.

mod cycle;
mod duplicate_joint_name;
mod duplicate_link_name;
mod joints_not_the_urdfs;
mod links_not_the_urdfs;
mod materials_not_the_urdfs;
mod mimic_circle;
mod mimic_of_many_dofs;
mod not_one_root;
mod parts;
mod source_differences;
mod two_parents;
mod unknown_link;
mod unknown_mimic_driver;
mod unreadable_urdf;
mod zero_axis;

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
