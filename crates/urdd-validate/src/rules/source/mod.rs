//! SRC: unusual robots, whose URDD may still be correct.

mod crossed_limits;
pub mod inertia_breaks_triangle;
pub mod inertia_not_positive_definite;
mod limits;
mod links;
mod mass_not_positive;
mod mesh_not_carried;
pub mod mimic_leaves_limits;
pub mod moments;
mod repeated_element;

use crate::rule::rules;
use links::links_of;

rules! {
    crossed_limits, inertia_breaks_triangle, inertia_not_positive_definite, limits,
    mass_not_positive, mesh_not_carried, mimic_leaves_limits, repeated_element
}
