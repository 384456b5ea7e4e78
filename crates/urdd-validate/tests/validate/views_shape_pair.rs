//! The statistics of a pair of shapes (SPEC 8.5).

use urdd_document::shape_matrices::Statistics;
use urdd_validate::views::tangled::*;

fn pair(mean: f64, min: f64, max: f64, samples: u32) -> Pair {
    let rows = |value: f64| vec![vec![0.0, value], vec![value, 0.0]];
    let (mean, min, max) = (rows(mean), rows(min), rows(max));
    let statistics = Statistics {
        keys: ["", "", ""],
        mean: &mean,
        min: &min,
        max: &max,
        num_samples: Some(samples),
    };
    Pairs::new(&statistics).read(0, 1).expect("sound elements")
}

#[test]
fn a_mean_of_equal_numbers_may_round() {
    let values = vec![0.1_f64; 1000];
    let mean = values.iter().sum::<f64>() / 1000.0;
    assert_ne!(mean, 0.1);
    assert!(pair(mean, 0.1, 0.1, 1000).in_order());
    assert!(!pair(0.1 + 1e-11, 0.1, 0.1, 1000).in_order());
    assert!(!pair(0.2, 0.3, 0.4, 1000).in_order());
}

#[test]
fn contact_is_undecided_only_at_its_edge() {
    let with_max = |max: f64| pair(0.0, 0.0, max, 10).always();
    assert_eq!(with_max(0.001), Some(true));
    assert_eq!(with_max(0.001 + 1e-15), None);
    assert_eq!(with_max(0.00101), Some(false));
    assert_eq!(with_max(0.0), Some(true));
}
