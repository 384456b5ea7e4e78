//! LOP: `loops_module`.

mod configurations;
mod couplings;
mod ends;
mod mobility;
mod open;

use crate::rule::rules;

rules! {
    ends, couplings, configurations, open, mobility
}
