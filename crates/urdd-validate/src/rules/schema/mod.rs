//! SCH: documents against their schemas.

mod breaks_schema;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[&breaks_schema::RULE];
