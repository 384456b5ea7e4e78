//! SRC: odd robots, whose URDD may be right all the same.

use crate::validate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[];
