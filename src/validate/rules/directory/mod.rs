//! DIR: what lies in the directory, and the root metadata.

use crate::validate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[];
