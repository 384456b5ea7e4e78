//! LNT: what is odd about a URDF, one rule a file.

mod axis_not_unit;
mod center_of_mass_outside;
mod inertia_beyond_geometry;
mod limits_look_like_degrees;
mod odd_density;
mod zero_outside_limits;

use crate::rule::LintRule;

/// Every rule, in the order of their codes.
pub fn all() -> Vec<&'static LintRule> {
    let mut rules = vec![
        &axis_not_unit::RULE,
        &center_of_mass_outside::RULE,
        &inertia_beyond_geometry::RULE,
        &limits_look_like_degrees::RULE,
        &odd_density::RULE,
        &zero_outside_limits::RULE,
    ];
    rules.sort_by_key(|rule| rule.description.code);
    rules
}
