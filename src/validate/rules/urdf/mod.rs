//! URD: `urdf_module` against the carried URDF, and as a tree.

use crate::validate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[];
