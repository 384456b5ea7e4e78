//! LEG: conventions of URDDs that were published before version 1.

use crate::validate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[];
