//! SRC: unusual robots, whose URDD may still be correct.

mod carried;
mod crossed_limits;
pub mod inertia;
mod limits;
mod mass;
pub mod mimic_leaves_limits;

use crate::rule::rules;

rules! {
    carried, crossed_limits, inertia, limits, mass, mimic_leaves_limits
}
