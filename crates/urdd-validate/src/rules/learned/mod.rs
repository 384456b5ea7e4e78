//! LRN: the learned self-collision model.

mod counts;
mod inputs;
mod numbers;
mod outputs;

use crate::rule::rules;

rules! {
    counts, inputs, numbers, outputs
}
