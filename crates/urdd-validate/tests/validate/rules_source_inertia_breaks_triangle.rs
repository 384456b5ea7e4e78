//! The rules of `source::inertia`.

use urdd_validate::rules::source::inertia::*;
use urdd_validate::tolerance::INERTIA_TRIANGLE;

#[test]
fn a_flat_plate_is_a_body() {
    assert!(excess([0.3, 0.7, 1.0]) <= INERTIA_TRIANGLE);
    assert!(excess([0.3, 0.699_999_8, 1.0]) <= INERTIA_TRIANGLE);
    assert!(excess([0.3, 0.699_998, 1.0]) > INERTIA_TRIANGLE);
}

#[test]
fn the_message_counts_from_the_sum_of_the_others() {
    assert!((beyond([0.2, 0.3, 0.6]) - 0.2).abs() < 1e-12);
    // A tolerance is of the moment itself.
    assert!((excess([0.2, 0.3, 0.6]) - 0.1 / 0.6).abs() < 1e-12);
}
