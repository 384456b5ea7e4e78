//! Arithmetic of the network for several configurations at once.

use urdd_learned::tanh;

#[test]
fn tanh_is_that_of_libm() {
    let mut worst: f64 = 0.0;
    for i in -200_000..=200_000 {
        let x = f64::from(i) * 1.3e-4;
        worst = worst.max((tanh(x) - libm::tanh(x)).abs());
    }
    assert!(worst < 4e-16, "{worst:e}");
    assert_eq!(tanh(f64::MAX), 1.0);
    assert_eq!(tanh(-1e9), -1.0);
    assert_eq!(tanh(0.0), 0.0);
}
