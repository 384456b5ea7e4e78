//! The rules of `source::inertia`.

use urdd_validate::rules::source::inertia::positive;
use urdd_validate::rules::source::inertia::principal;

#[test]
fn thin_is_not_singular() {
    // A steel rod of 1 m, 0.1 mm thick.
    assert!(positive(principal([0.083, 0.0, 0.0, 0.083, 0.0, 1.25e-9])));
    assert!(!positive(principal([0.083, 0.0, 0.0, 0.083, 0.0, 0.0])));
    assert!(!positive(principal([1.0, 1.0, 0.0, 1.0, 0.0, 1.0])));
    assert!(!positive(principal([-1.0, 0.0, 0.0, -1.0, 0.0, -1.0])));
}
