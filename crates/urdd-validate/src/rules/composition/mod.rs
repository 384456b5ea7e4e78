//! CMP: how a robot was put together from others.

mod parts;

use crate::rule::rules;

rules! {
    parts
}
