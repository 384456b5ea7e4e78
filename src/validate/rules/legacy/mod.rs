//! LEG: conventions of URDDs that were published before version 1.

pub mod adjusted_mappings_wrong;
pub mod locked_bound_widened;

use crate::validate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[&adjusted_mappings_wrong::RULE, &locked_bound_widened::RULE];
