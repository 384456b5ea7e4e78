//! JSN: JSON as text.

mod json_byte_order_mark;
mod json_not_utf8;
mod json_too_deep;
mod not_json;
mod number_not_finite;
mod repeated_key;

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
