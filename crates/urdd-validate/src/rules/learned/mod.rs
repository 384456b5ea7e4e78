//! LRN: the learned self-collision model.

pub mod counts;
mod numbers;
mod outputs;

use crate::rule::rules;

rules! {
    counts, numbers, outputs
}
