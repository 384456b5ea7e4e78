//! BND: `bounds_module`.

pub mod bound_count;
pub mod bounds_columns_differ;

use crate::validate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[&bound_count::RULE, &bounds_columns_differ::RULE];
