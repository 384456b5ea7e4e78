//! Pairs of links that need no collision check.

use SkipReason::{Adjacent, Always, Default as Resting, Never, None as Sometimes};
use urdd_export::pairs::*;
use urdd_format::link_shapes_simple_skips::SkipReason;

#[test]
fn a_pair_of_links_is_what_its_shapes_make_it() {
    let of = |reasons: &[SkipReason]| together(reasons.iter().copied().map(Some));
    assert_eq!(of(&[Never, Never]), Some(Never));
    assert_eq!(of(&[Never, Sometimes]), Some(Sometimes));
    assert_eq!(of(&[Never, Resting, Sometimes]), Some(Resting));
    assert_eq!(of(&[Adjacent, Always]), Some(Always));
    assert_eq!(of(&[Adjacent, Adjacent]), Some(Adjacent));
    assert_eq!(together([Some(Never), None].into_iter()), None);
}

#[test]
fn names_in_very_many_pairs_are_charged() {
    // 300 links, and 500 pieces, with ordinary names; 2,000 links without a table.
    for (longest, shapes) in [(40, 300), (60, 500), (40, 2_000), (100_000, 20)] {
        assert!(charge(longest * shapes, shapes).is_ok(), "{longest} {shapes}");
    }
    assert!(charge(40_000 * 300, 300).is_err());
    assert!(charge(usize::MAX / 1000, 2_000).is_err());
}
