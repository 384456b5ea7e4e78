//! EXT: extension modules.

use crate::validate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[];
