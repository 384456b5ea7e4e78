//! The rules of `source::limits`.

use urdd_validate::rules::source::limits::*;

#[test]
fn a_negative_multiplier_turns_the_interval_round() {
    assert_eq!(follow((-1.0, 2.0), -0.5, 0.25), (-0.75, 0.75));
    assert_eq!(follow((-1.0, 2.0), 2.0, 0.0), (-2.0, 4.0));
    assert_eq!(follow((-1.0, 2.0), 0.0, 0.5), (0.5, 0.5));
}
