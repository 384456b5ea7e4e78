//! CMP: how a robot was put together from others.

mod parts;
mod whole;

use crate::rule::rules;

rules! {
    parts, whole
}
