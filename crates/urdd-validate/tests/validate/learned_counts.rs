//! Counts how often a model is right: SPEC 8.8.9 and 8.8.10.

use urdd_validate::learned::*;

#[test]
fn a_step_ends_after_0_05_or_at_the_next_configuration() {
    assert_eq!(stepped(&[0.0, 1.0], &[0.02, 0.99]), [0.02, 0.99]);
    let moved = stepped(&[0.0, 1.0], &[-0.5, 2.0]);
    assert!((moved[0] + 0.025).abs() < 1e-15 && (moved[1] - 1.05).abs() < 1e-15);
    assert_eq!(stepped(&[0.5], &[0.5]), [0.5]);
}
