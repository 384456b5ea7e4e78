//! JSN: JSON as text.

mod json_byte_order_mark;
mod json_not_utf8;
mod json_too_deep;
mod not_json;
mod number_not_finite;
mod repeated_key;

use crate::rule::rules;

rules! {
    json_byte_order_mark, json_not_utf8, json_too_deep, not_json, number_not_finite,
    repeated_key
}
