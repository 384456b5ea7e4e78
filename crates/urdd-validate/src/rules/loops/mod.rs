//! LOP: `loops_module`.

mod configurations;
mod couplings;
mod ends;
mod mobility;

use crate::rule::rules;

rules! {
    ends, couplings, configurations, mobility
}
