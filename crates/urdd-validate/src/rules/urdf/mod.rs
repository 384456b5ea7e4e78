//! URD: `urdf_module` against the carried URDF, and as a tree.

pub mod cycle;
mod duplicate_joint_name;
mod duplicate_link_name;
mod joints_not_the_urdfs;
mod links_not_the_urdfs;
mod materials_not_the_urdfs;
mod mimic_circle;
mod mimic_of_many_dofs;
mod not_one_root;
pub mod parts;
mod repeated_names;
pub mod source_differences;
mod two_parents;
mod unknown_link;
mod unknown_mimic_driver;
mod unreadable_urdf;
pub mod zero_axis;

use crate::rule::rules;

rules! {
    cycle, duplicate_joint_name, duplicate_link_name, joints_not_the_urdfs, links_not_the_urdfs,
    materials_not_the_urdfs, mimic_circle, mimic_of_many_dofs, not_one_root, two_parents,
    unknown_link, unknown_mimic_driver, unreadable_urdf, zero_axis
}
