//! EXT: extension modules.

pub mod document_invalid;
pub mod schema_unusable;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[&schema_unusable::RULE, &document_invalid::RULE];
