//! SRC: odd robots, whose URDD may be right all the same.

pub mod crossed_limits;
pub mod inertia_breaks_triangle;
pub mod inertia_not_positive_definite;
pub mod mass_not_positive;
pub mod mesh_not_carried;
pub mod mimic_leaves_limits;
mod moments;
pub mod no_effort_and_no_speed;
pub mod no_limits;
pub mod repeated_element;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &crossed_limits::RULE,
    &mimic_leaves_limits::RULE,
    &mass_not_positive::RULE,
    &inertia_not_positive_definite::RULE,
    &inertia_breaks_triangle::RULE,
    &no_limits::RULE,
    &mesh_not_carried::RULE,
    &repeated_element::RULE,
    &no_effort_and_no_speed::RULE,
];
