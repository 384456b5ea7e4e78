//! LRN: the learned self-collision model.

mod counts;
mod index_out_of_range;
mod input_wrong;
mod numbers;
mod other_geometry;
mod output_differs;
mod pairs_differ;

use crate::rule::rules;

rules! {
    counts, index_out_of_range, input_wrong, numbers, other_geometry, output_differs,
    pairs_differ
}
