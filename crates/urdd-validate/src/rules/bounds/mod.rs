//! BND: `bounds_module`.

mod bound_count_wrong;
mod bound_differs_from_limit;
mod bounds_columns_differ;
mod limited_flag_wrong;
mod speed_or_effort_differs;
mod unlimited_bounds_wrong;

use crate::rule::Rule;
use crate::tolerance::numbers_agree;
use urdd_document::bounds::Bounds;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &bound_count_wrong::RULE,
    &bounds_columns_differ::RULE,
    &bound_differs_from_limit::RULE,
    &limited_flag_wrong::RULE,
    &speed_or_effort_differs::RULE,
    &unlimited_bounds_wrong::RULE,
];

/// Whether `bounds` and the list of that end agree about a DOF; BND002 reports where they do not.
fn columns_agree(bounds: Bounds<'_>, dof: usize, end: usize) -> bool {
    let list = [bounds.lower, bounds.upper][end];
    let pair = bounds.bounds.get(dof);
    pair.zip(list.get(dof))
        .is_none_or(|(pair, value)| numbers_agree(pair[end], *value))
}

/// By how much legacy modules raised an upper bound that was equal to the lower one (SPEC 10.3).
pub const LEGACY_WIDENING: f64 = 1e-7;
