//! Principal moments of inertia.

use urdd_validate::rules::source::inertia::*;

#[test]
fn agrees_with_numpy() {
    // numpy.linalg.eigvalsh([[4, -.5, .3], [-.5, 5, .2], [.3, .2, 6]])
    let expected = [3.737_516_65, 5.201_588_51, 6.060_894_84];
    for (moment, expected) in principal([4.0, -0.5, 0.3, 5.0, 0.2, 6.0]).iter().zip(expected) {
        assert!((moment - expected).abs() < 1e-8, "{moment} {expected}");
    }
}

#[test]
fn comes_to_an_end_whatever_the_size() {
    for size in [1e-310, 1e-200, 1e200, f64::MAX] {
        let moments = principal([size, size, -size, 0.0, size, -size]);
        assert!(moments[0] <= moments[1] && moments[1] <= moments[2]);
    }
    assert_eq!(principal([0.0; 6]), [0.0; 3]);
}
