//! BND: `bounds_module`.

pub mod bound_count_wrong;
pub mod bound_differs_from_limit;
pub mod bounds_columns_differ;
pub mod limited_flag_wrong;
pub mod speed_or_effort_differs;
pub mod unlimited_bounds_wrong;

use crate::validate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &bound_count_wrong::RULE,
    &bounds_columns_differ::RULE,
    &bound_differs_from_limit::RULE,
    &limited_flag_wrong::RULE,
    &speed_or_effort_differs::RULE,
    &unlimited_bounds_wrong::RULE,
];

/// By how much legacy modules raised an upper bound that was equal to the lower one (SPEC 10.3).
pub const LEGACY_WIDENING: f64 = 1e-7;
