//! SRC: odd robots, whose URDD may be right all the same.

mod crossed_limits;
mod inertia_breaks_triangle;
mod inertia_not_positive_definite;
mod mass_not_positive;
mod mesh_not_carried;
mod mimic_leaves_limits;
mod moments;
mod no_effort_and_no_speed;
mod no_limits;
mod repeated_element;

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
