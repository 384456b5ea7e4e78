//! CMP: how a robot was put together from others.

mod attachment_wrong;
mod not_one_to_one;
mod parts;

use crate::rule::rules;

rules! {
    attachment_wrong, not_one_to_one, parts
}
