//! Statistics of parts of the samples, joined.

use urdd_geometry::convex::PairStatistics;
use urdd_validate::distances::*;

#[test]
fn parts_are_joined_by_their_sizes() {
    let of = |distances: &[f64]| {
        let rows = |x: f64| vec![vec![0.0, x], vec![x, 0.0]];
        let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
        let most = distances.iter().copied().fold(0.0, f64::max);
        let mean = distances.iter().sum::<f64>() / distances.len() as f64;
        PairStatistics { mean: rows(mean), min: rows(least), max: rows(most) }
    };
    let mut all = of(&[1.0, 2.0, 6.0]);
    join(&mut all, &of(&[0.5]), 3, 4);
    let expected = of(&[1.0, 2.0, 6.0, 0.5]);
    assert_eq!(all.min, expected.min);
    assert_eq!(all.max, expected.max);
    assert!((all.mean[0][1] - 2.375).abs() < 1e-15);
}
