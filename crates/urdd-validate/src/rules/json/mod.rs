//! JSN: JSON as text.

pub mod json_byte_order_mark;
pub mod json_not_utf8;
pub mod json_too_deep;
pub mod not_json;
pub mod number_not_finite;
pub mod repeated_key;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &not_json::RULE,
    &repeated_key::RULE,
    &json_not_utf8::RULE,
    &json_byte_order_mark::RULE,
    &number_not_finite::RULE,
    &json_too_deep::RULE,
];
