//! The rules of `chain::origins`.

use urdd_validate::rules::chain::joints::is_negative;

#[test]
fn w_counts_first_and_zeros_do_not() {
    assert!(!is_negative(&[0.5, -0.5, -0.5, -0.5]));
    assert!(is_negative(&[-0.5, 0.5, 0.5, 0.5]));
    assert!(is_negative(&[-0.0, 0.0, -1.0, 0.0]));
    assert!(!is_negative(&[-0.0, 1.0, 0.0, 0.0]));
    assert!(is_negative(&[-1e-17, 1.0, 0.0, 0.0]));
}
