//! LRN: the learned self-collision model.

mod counts_differ;
mod counts_few;
mod counts_impossible;
mod index_out_of_range;
mod input_wrong;
mod other_geometry;
mod output_differs;
mod overflow;
mod pairs_differ;
mod rates_not_met;
mod too_large;
mod wrong_shape;

use crate::rule::rules;

rules! {
    counts_differ, counts_few, counts_impossible, index_out_of_range, input_wrong,
    other_geometry, output_differs, overflow, pairs_differ, rates_not_met, too_large,
    wrong_shape
}
