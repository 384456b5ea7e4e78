//! The configurations that the specification defines.

use std::f64::consts::{PI, TAU};

use urdd_format::urdf::JointType::*;
use urdd_kinematics::configurations::bits;
use urdd_kinematics::rotation::from_rotation_vector;
use urdd_kinematics::{ConfigurationSpace, unit};

use testkit::core_modules::{Joint, chain_of};

const X: [f64; 3] = [1.0, 0.0, 0.0];

/// Prismatic joints with these bounds.
fn slides(bounds: &[[f64; 2]]) -> ConfigurationSpace {
    let joints: Vec<Joint> = (0..bounds.len()).map(|i| Joint::after(i, Prismatic, X)).collect();
    let (chain, dof) = chain_of(&joints);
    ConfigurationSpace::new(&dof, &chain, bounds).unwrap()
}

/// A slide, a floating joint and a ball: DOF 0, DOFs 1 to 6, DOFs 7 to 9.
fn with_rotation_vectors() -> ConfigurationSpace {
    let joints = [
        Joint::after(0, Prismatic, X),
        Joint::after(1, Floating, X),
        Joint::after(2, Spherical, X),
    ];
    let (chain, dof) = chain_of(&joints);
    let mut bounds = vec![[-1.0, 3.0]; 4];
    bounds.extend([[-PI, PI]; 6]);
    ConfigurationSpace::new(&dof, &chain, &bounds).unwrap()
}

#[test]
fn units_are_the_upper_53_bits() {
    // The first outputs of SplitMix64 with seed 0, as published with the generator.
    let published = [0xE220_A839_7B1D_CDAF_u64, 0x6E78_9E6A_A1B9_65F4, 0x06C4_5D18_8009_454F];
    for (i, bits) in (0..).zip(published) {
        assert_eq!(unit(0, i), (bits / 2048) as f64 / 9_007_199_254_740_992.0);
    }
}

#[test]
fn units_fill_the_interval_evenly_across_samples_and_dofs() {
    let (samples, dofs) = (2000, 20);
    for i in 0..dofs {
        let column: Vec<f64> = (0..samples).map(|k| unit(k, i)).collect();
        let mean = column.iter().sum::<f64>() / samples as f64;
        assert!((mean - 0.5).abs() < 0.03, "DOF {i}: mean {mean}");
        assert!(column.iter().all(|u| (0.0..1.0).contains(u)));
    }
}

#[test]
fn the_five_kinds() {
    let space = slides(&[[-1.0, 3.0], [0.25, 0.25], [-7.3, 7.3]]);
    assert_eq!(space.num_dofs(), 3);
    assert_eq!(space.zero(), [0.0, 0.0, 0.0]);
    assert_eq!(space.middle(), [1.0, 0.25, 0.0]);
    assert_eq!(space.lower(), [-1.0, 0.25, -7.3]);
    assert_eq!(space.upper(), [3.0, 0.25, 7.3]);
    for k in [0, 1, 41] {
        let between = |lower: f64, upper: f64, u: f64| lower * (1.0 - u) + upper * u;
        let sampled = space.sampled(k);
        assert_eq!(sampled[0], between(-1.0, 3.0, unit(k, 0)));
        assert!((sampled[1] - 0.25).abs() <= f64::EPSILON, "{sampled:?}");
        assert_eq!(sampled[2], between(-7.3, 7.3, unit(k, 2)));
    }
}

#[test]
fn nothing_overflows() {
    let space = slides(&[[-f64::MAX, f64::MAX], [f64::MAX, f64::MAX]]);
    assert_eq!(space.middle(), [0.0, f64::MAX]);
    for k in 0..100 {
        let q = space.sampled(k);
        let expected = (2.0 * unit(k, 0) - 1.0) * f64::MAX;
        assert!((q[0] / expected - 1.0).abs() < 1e-12);
        assert!(q[1].is_finite() && (q[1] / f64::MAX - 1.0).abs() <= f64::EPSILON);
    }
}

#[test]
fn no_value_is_negative_zero() {
    let space = slides(&[[-0.0, -0.0], [0.0, -0.0]]);
    for q in [space.middle(), space.lower(), space.upper(), space.sampled(0)] {
        assert!(q.iter().all(|value| value.to_bits() == 0), "{q:?}");
    }
}

#[test]
fn crossed_bounds_are_taken_as_they_are() {
    let space = slides(&[[3.0, -1.0]]);
    assert_eq!((space.lower(), space.middle(), space.upper()), (vec![3.0], vec![1.0], vec![-1.0]));
    assert_eq!(space.sampled(0), [3.0 - 4.0 * unit(0, 0)]);
}

#[test]
fn rotation_vectors_have_bounds_of_their_own() {
    let space = with_rotation_vectors();
    assert_eq!(space.middle(), [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(space.lower(), [-1.0, -1.0, -1.0, -1.0, -PI, 0.0, 0.0, -PI, 0.0, 0.0]);
    assert_eq!(space.upper(), [3.0, 3.0, 3.0, 3.0, PI, 0.0, 0.0, PI, 0.0, 0.0]);
}

#[test]
fn sampled_rotation_vectors_are_shoemakes_quaternions() {
    let space = with_rotation_vectors();
    for k in 0..200 {
        let q = space.sampled(k);
        assert_eq!(q[3], -(1.0 - unit(k, 3)) + 3.0 * unit(k, 3));
        for first in [4, 7] {
            let [u1, u2, u3] = [0, 1, 2].map(|i| unit(k, (first + i) as u64));
            let (a, b) = ((1.0 - u1).sqrt(), u1.sqrt());
            let (s2, c2) = (TAU * u2).sin_cos();
            let (s3, c3) = (TAU * u3).sin_cos();
            let expected = [b * c3, a * s2, a * c2, b * s3];
            let sign = expected[0].signum();
            let vector = [q[first], q[first + 1], q[first + 2]];
            let found = from_rotation_vector(vector);
            let found = [found.w, found.i, found.j, found.k];
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - sign * expected).abs() < 1e-15, "sample {k}");
            }
            assert!(vector.iter().map(|x| x * x).sum::<f64>().sqrt() <= PI * (1.0 + 1e-15));
        }
    }
}

#[test]
fn sampled_rotations_are_uniform() {
    // The angle of a uniform rotation has the distribution (a - sin a)/pi, and therefore the mean pi/2 + 2/pi.
    let space = with_rotation_vectors();
    let count = 4000;
    let angles = (0..count).map(|k| {
        let q = space.sampled(k);
        (q[7] * q[7] + q[8] * q[8] + q[9] * q[9]).sqrt()
    });
    let mean = angles.sum::<f64>() / count as f64;
    assert!((mean - (PI / 2.0 + 2.0 / PI)).abs() < 0.04, "mean angle {mean}");
}

/// The first outputs of SplitMix64 with seed 0, as published with the generator.
const PUBLISHED: [u64; 3] = [0xE220_A839_7B1D_CDAF, 0x6E78_9E6A_A1B9_65F4, 0x06C4_5D18_8009_454F];

#[test]
fn is_splitmix64() {
    for (i, published) in (0..).zip(PUBLISHED) {
        assert_eq!(bits(0, i), published);
    }
}

#[test]
fn sample_k_goes_on_where_the_generator_is_after_k_times_2_to_the_32() {
    assert_eq!(bits(3, 5), bits(0, (3 << 32) + 5));
    assert_eq!(bits(1 << 32, 5), bits(0, 5), "wraps at 64 bits");
}
