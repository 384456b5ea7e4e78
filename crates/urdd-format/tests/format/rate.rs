//! Rates and their intervals, compared with closed forms and with SciPy.

use urdd_format::rate::{Rate, interval};

/// `scipy.stats.norm.ppf(0.975)`.
const Z: f64 = 1.959963984540054;

/// `conformance/vectors/self_collision_model.json` has more cases, computed with scipy.
#[test]
fn ends_at_nothing_and_all_are_closed_forms() {
    // 0 of n: z^2 / (n + z^2); n of n: 1 minus that.
    for n in [1, 10, 300, 50_000] {
        let most = Z * Z / (f64::from(n) + Z * Z);
        let (none, all) = (Rate::new(0, n), Rate::new(n, n));
        assert!((none.upper - most).abs() < 1e-15 && none.lower == 0.0);
        assert!((all.lower - (1.0 - most)).abs() < 1e-15 && all.upper == 1.0);
    }
}

#[test]
fn intervals_are_those_of_scipy() {
    // From scipy.stats.binomtest(k, n).proportion_ci(method="wilson"), SciPy 1.17.
    for (count, of, low, high) in
        [(9, 903, 0.005252, 0.018833), (0, 10_000, 0.0, 0.000384), (50, 50, 0.928652, 1.0)]
    {
        let [a, b] = interval(count, of);
        assert!((a - low).abs() < 1e-6 && (b - high).abs() < 1e-6, "{a} {b}");
    }
}

#[test]
fn out_of_nothing_nothing_is_known() {
    let rate = Rate::new(0, 0);
    assert_eq!((rate.lower, rate.upper, rate.share()), (0.0, 1.0, None));
    assert_eq!(rate.to_string(), "none of 0");
}

#[test]
fn words() {
    assert_eq!(Rate::new(9, 903).to_string(), "1.00 % (0.53 to 1.88 %) of 903");
    assert!(Rate::new(50, 1_234_567).to_string().ends_with("of 1,234,567"));
    assert!(Rate::new(50, 100).is_above(&Rate::new(9, 903)));
    assert!(!Rate::new(2, 100).is_above(&Rate::new(9, 903)));
}
