//! EXT: extension modules.

mod document_invalid;
mod schema_unusable;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[&schema_unusable::RULE, &document_invalid::RULE];
