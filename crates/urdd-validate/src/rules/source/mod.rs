//! SRC: unusual robots, whose URDD may still be correct.

mod carried;
mod crossed_limits;
pub mod inertia;
pub mod limits;

use crate::rule::rules;

rules! {
    carried, crossed_limits, inertia, limits
}
