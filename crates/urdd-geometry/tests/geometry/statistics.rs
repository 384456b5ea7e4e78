//! Statistics of pairs of shapes over samples.

use std::sync::atomic::{AtomicUsize, Ordering};

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use urdd_geometry::convex::{
    ConvexShape, Motion, MotionError, PairStatistics, PlacedShape, Sphere, distance,
    pair_distances, pair_ranges, pair_statistics, statistics_of_kinds,
};

/// Numbers from 0 to 1, the same in each run (SplitMix64).
fn numbers() -> impl FnMut() -> f64 {
    let mut state = 0_u64;
    move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 * (0.5_f64).powi(53)
    }
}

/// Four bodies in `num_samples` samples; 1 and 3 are in one group.
fn poses(num_samples: usize) -> Vec<Vec<Isometry3<f64>>> {
    let mut next = numbers();
    let mut pose = || {
        let t = Translation3::new(2.0 * next(), 2.0 * next(), 2.0 * next());
        Isometry3::from_parts(
            t,
            UnitQuaternion::from_euler_angles(6.0 * next(), 3.0 * next(), 6.0 * next()),
        )
    };
    let fixed = pose();
    (0..num_samples)
        .map(|_| {
            let [a, b, c] = [pose(), pose(), pose()];
            vec![a, b, c, b * fixed]
        })
        .collect()
}

const GROUPS: [usize; 4] = [0, 1, 2, 1];

/// Seven shapes: two on each body except the last.
fn shapes() -> Vec<PlacedShape<ConvexShape>> {
    let mut next = numbers();
    (0..7)
        .map(|i| {
            let points: Vec<[f64; 3]> = (0..4 + 5 * i).map(|_| [next(), next(), next()]).collect();
            PlacedShape {
                body: [2, 0, 3, 1, 0, 1, 2][i],
                shape: ConvexShape::of_points(&points).expect("a shape"),
            }
        })
        .collect()
}

fn statistics(num_samples: usize) -> PairStatistics {
    let motion = Motion::new(&poses(num_samples), &GROUPS).expect("a motion");
    pair_statistics(&shapes(), &motion).expect("bodies of the motion")
}

#[test]
fn every_pair_is_summed_up() {
    // Not a multiple of the number of samples processed at once.
    for num_samples in [1, 7, 8, 21] {
        let (poses, shapes, found) = (poses(num_samples), shapes(), statistics(num_samples));
        for i in 0..shapes.len() {
            for j in 0..shapes.len() {
                let each: Vec<f64> = poses
                    .iter()
                    .map(|p| {
                        let b_in_a = p[shapes[i].body].inv_mul(&p[shapes[j].body]);
                        let apart = distance(&shapes[i].shape, &shapes[j].shape, &b_in_a);
                        if i == j { 0.0 } else { apart }
                    })
                    .collect();
                let mean = each.iter().sum::<f64>() / num_samples as f64;
                let min = each.iter().copied().fold(f64::INFINITY, f64::min);
                let max = each.iter().copied().fold(0.0, f64::max);
                for (found, expected) in [(&found.mean, mean), (&found.min, min), (&found.max, max)]
                {
                    let found = found[i][j];
                    assert!(
                        (found - expected).abs() < 3e-9,
                        "{num_samples} {i} {j}: {found} {expected}"
                    );
                }
            }
        }
    }
}

#[test]
fn pairs_that_do_not_move_are_constant_to_the_bit() {
    let found = statistics(50);
    // Shapes on bodies 1 and 3, which are one group, and on the same body.
    for (i, j) in [(2, 3), (2, 5), (3, 5), (1, 4), (0, 6)] {
        assert_eq!(found.min[i][j], found.max[i][j]);
        assert_eq!(found.mean[i][j], found.max[i][j]);
    }
    assert!(found.min[0][1] < found.max[0][1]);
}

#[test]
fn symmetric_with_zeros_on_the_diagonal() {
    let found = statistics(9);
    for matrix in [&found.mean, &found.min, &found.max] {
        assert_eq!(matrix.len(), 7);
        for (i, row) in matrix.iter().enumerate() {
            assert_eq!(row.len(), 7);
            assert_eq!(row[i], 0.0);
            let column: Vec<f64> = matrix.iter().map(|row| row[i]).collect();
            assert_eq!(*row, column);
        }
    }
}

#[test]
fn the_same_bits_for_each_number_of_threads() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| statistics(100))
    };
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(8));
}

#[test]
fn spheres_on_a_circle() {
    // A sphere of radius 0.25 moves around one of radius 0.5 at distances of 2, 1 and 0.5 between the centres.
    let at = |x: f64, y: f64| vec![Isometry3::identity(), Isometry3::translation(x, y, 0.0)];
    let motion =
        Motion::new(&[at(2.0, 0.0), at(0.0, 1.0), at(-0.5, 0.0)], &[0, 1]).expect("a motion");
    let sphere = |body, radius| PlacedShape {
        body,
        shape: Sphere::new(Vector3::zeros(), radius).expect("a sphere"),
    };
    let found =
        pair_statistics(&[sphere(0, 0.5), sphere(1, 0.25)], &motion).expect("bodies of the motion");
    assert_eq!([found.mean[0][1], found.min[0][1], found.max[0][1]], [0.5, 0.0, 1.25]);
}

#[test]
fn the_distance_in_each_sample() {
    // Three spheres of radius 0.25: one moves away from the first; the last moves with it, 1 above.
    let at = |x: f64| {
        vec![
            Isometry3::identity(),
            Isometry3::translation(x, 0.0, 0.0),
            Isometry3::translation(x, 0.0, 1.0),
        ]
    };
    let motion = Motion::new(&[at(0.25), at(1.0), at(3.0)], &[0, 1, 1]).expect("a motion");
    let on =
        |body| PlacedShape { body, shape: Sphere::new(Vector3::zeros(), 0.25).expect("a sphere") };
    let pair = |a, b| pair_distances(&on(a), &on(b), &motion);
    assert_eq!(pair(0, 1), Some(vec![0.0, 0.5, 2.5]));
    assert_eq!(pair(1, 2), Some(vec![0.5; 3]));
    assert_eq!(pair(0, 3), None);
}

#[test]
fn what_is_no_motion() {
    assert_eq!(Motion::new(&[], &[]).err(), Some(MotionError::NoSamples));
    let rows = [vec![Isometry3::identity(); 2], vec![Isometry3::identity()]];
    let fault = MotionError::Bodies { sample: 1, expected: 2, found: 1 };
    assert_eq!(Motion::new(&rows, &[0, 1]).err(), Some(fault));
    let rows = [vec![Isometry3::translation(0.0, f64::NAN, 0.0)]];
    assert_eq!(Motion::new(&rows, &[0]).err(), Some(MotionError::NotFinite { sample: 0, body: 0 }));
    let motion = Motion::new(&[vec![Isometry3::identity()]], &[0]).expect("a motion");
    assert_eq!(pair_statistics(&shapes(), &motion), None);
    assert_eq!(pair_statistics::<Sphere>(&[], &motion), Some(PairStatistics::default()));
}

#[test]
fn a_range_is_left_exactly_if_a_distance_is_outside() {
    let motion = Motion::new(&poses(21), &GROUPS).expect("a motion");
    let (shapes, exact) = (shapes(), statistics(21));
    let ranges = |low: f64, high: f64| {
        let range = |i: usize, j: usize| {
            assert!(i < j);
            Some([exact.min[i][j] + low, exact.max[i][j] + high])
        };
        pair_ranges(&shapes, &motion, range).expect("bodies of the motion")
    };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-8;
    let (mut early, mut pairs) = (0, 0);
    for i in 0..shapes.len() {
        for j in i + 1..shapes.len() {
            let (min, max) = (exact.min[i][j], exact.max[i][j]);
            // The stated range is right, or wider.
            for slack in [0.0, 0.01] {
                let found = ranges(-slack, slack);
                let (low, high) = (found.min[i][j], found.max[i][j]);
                assert!(low >= min - slack - 1e-8 && high <= max + slack + 1e-8);
                early += usize::from(!near(found.mean[i][j], exact.mean[i][j]));
            }
            // It is too narrow at one end.
            assert!(near(ranges(0.01, 0.0).min[i][j], min));
            assert!(near(ranges(0.0, -0.01).max[i][j], max));
            pairs += 1;
        }
    }
    assert!(early > pairs / 2, "{early} of {pairs}");
    let all = pair_ranges(&shapes, &motion, |_, _| None);
    assert_eq!(all, Some(exact));
}

#[test]
fn it_stops_before_the_next_pair() {
    let motion = Motion::new(&poses(20), &GROUPS).expect("a motion");
    let shapes = shapes();
    let asked = AtomicUsize::new(0);
    let stops_after = |count: usize| {
        let asked = &asked;
        move || asked.fetch_add(1, Ordering::Relaxed) >= count
    };
    let all = statistics_of_kinds(&[&&shapes[..]], &motion, &stops_after(usize::MAX));
    assert_eq!(all, Some(vec![statistics(20)]));
    // Once for each pair of the seven shapes.
    assert_eq!(asked.swap(0, Ordering::Relaxed), 21);
    let stopped = statistics_of_kinds(&[&&shapes[..]], &motion, &stops_after(3));
    assert_eq!(stopped, None);
    // Shapes whose pairs have not begun may check for cancellation once each.
    assert!(asked.into_inner() < 21);
}
