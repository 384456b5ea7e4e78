//! The rules of `bounds::unlimited`.

use urdd_validate::rules::bounds::is_frozen;

#[test]
fn what_legacy_modules_added_is_no_range() {
    assert!(is_frozen([0.0, 1e-7]));
    assert!(is_frozen([3.0, 3.0 + 1e-7]));
    assert!(!is_frozen([0.0, 1e-6]));
}
