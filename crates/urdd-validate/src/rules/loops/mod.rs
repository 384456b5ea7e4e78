//! LOP: `loops_module`.

mod configurations;
mod ties;

use crate::rule::rules;

rules! {
    ties, configurations
}
