//! Rotations and poses: conversions and distances.

use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use urdd_format::pose::Pose;
use urdd_kinematics::pose::{PoseError, from_isometry, to_isometry};
use urdd_kinematics::rotation::*;

use crate::naive_kinematics::rpy as naive_rpy;

fn quaternion(wxyz: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(wxyz[0], wxyz[1], wxyz[2], wxyz[3]))
}

#[test]
fn of_two_quaternions_one_is_canonical() {
    for (wxyz, expected) in [
        ([-0.6, 0.8, 0.0, 0.0], [0.6, -0.8, 0.0, 0.0]),
        ([0.6, -0.8, 0.0, 0.0], [0.6, -0.8, 0.0, 0.0]),
        ([-0.0, -1.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]),
        ([0.0, -0.0, -0.6, 0.8], [0.0, 0.0, 0.6, -0.8]),
        ([0.0, 0.0, 0.0, -1.0], [0.0, 0.0, 0.0, 1.0]),
        ([0.0, 0.6, -0.8, 0.0], [0.0, 0.6, -0.8, 0.0]),
        ([-1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]),
    ] {
        let isometry = Isometry3::from_parts(Translation3::new(-0.0, 1.0, -2.0), quaternion(wxyz));
        let pose = from_isometry(&isometry);
        let expected = Pose { position: [0.0, 1.0, -2.0], quaternion_wxyz: expected };
        // As text, since -0.0 equals 0.0 in numbers.
        let text = |pose: &Pose| serde_json::to_string(pose).unwrap();
        assert_eq!(text(&pose), text(&expected));
        assert!(!text(&pose).contains("-0.0"));
    }
}

#[test]
fn a_pose_that_is_no_rigid_transform() {
    let pose = |position, quaternion_wxyz| to_isometry(&Pose { position, quaternion_wxyz });
    let identity = [1.0, 0.0, 0.0, 0.0];
    assert_eq!(pose([f64::NAN, 0.0, 0.0], identity), Err(PoseError::Position));
    assert_eq!(pose([0.0; 3], [0.0; 4]), Err(PoseError::NotUnit { norm: 0.0 }));
    assert_eq!(pose([0.0; 3], [1.0, 1.0, 1.0, 1.0]), Err(PoseError::NotUnit { norm: 2.0 }));
    assert!(pose([0.0; 3], [f64::NAN, 0.0, 0.0, 1.0]).is_err());
    assert_eq!(pose([1.0, 2.0, 3.0], identity), Ok(Isometry3::translation(1.0, 2.0, 3.0)));
}

#[test]
fn unit_axes() {
    let axis = |v| unit_axis(v).map(|unit| <[f64; 3]>::from(unit.into_inner()));
    assert_eq!(axis([0.0, -3.0, 4.0]), Some([0.0, -0.6, 0.8]));
    assert_eq!(axis([1e-320, 0.0, 0.0]), Some([1.0, 0.0, 0.0]));
    assert_eq!(axis([0.0, -1e308, 1e308]), axis([0.0, -1.0, 1.0]));
    assert_eq!(axis([0.0; 3]), None);
    assert_eq!(axis([f64::NAN, 1.0, 0.0]), None);
    assert_eq!(axis([f64::INFINITY, 1.0, 0.0]), None);
    assert!(axis([-0.0, 2.0, -0.0]).unwrap().iter().all(|x| x.is_sign_positive()));
}

#[test]
fn half_a_turn_has_one_rotation_vector() {
    assert_eq!(to_rotation_vector(&quaternion([0.0, 0.0, -1.0, 0.0])), [0.0, PI, 0.0]);
    assert_eq!(to_rotation_vector(&quaternion([-0.0, 0.0, 0.6, -0.8])), [0.0, 0.6 * PI, -0.8 * PI]);
    let [_, short_of, _] = to_rotation_vector(&quaternion([1e-12, 0.0, -1.0, 0.0]));
    assert!((short_of + (PI - 2e-12)).abs() < 1e-15, "{short_of}");
    assert_eq!(to_rotation_vector(&UnitQuaternion::identity()), [0.0; 3]);
}

#[test]
fn fixed_axis_angles_turn_roll_first() {
    // A quarter turn each: roll takes y to z, pitch that to x, yaw that to y.
    let turned = from_rpy([FRAC_PI_2; 3]) * Vector3::y();
    assert!((turned - Vector3::y()).norm() < 1e-15, "{turned}");
    // Each about its own axis.
    assert!((from_rpy([FRAC_PI_2, 0.0, 0.0]) * Vector3::y() - Vector3::z()).norm() < 1e-15);
    assert!((from_rpy([0.0, FRAC_PI_2, 0.0]) * Vector3::z() - Vector3::x()).norm() < 1e-15);
    assert!((from_rpy([0.0, 0.0, FRAC_PI_2]) * Vector3::x() - Vector3::y()).norm() < 1e-15);
    // A quarter turn of roll takes z to -y; yaw takes that to x. Yaw first would give -y.
    let turned = from_rpy([FRAC_PI_2, 0.0, FRAC_PI_2]) * Vector3::z();
    assert!((turned - Vector3::x()).norm() < 1e-15, "{turned}");
}

#[test]
fn distances() {
    let about = |axis: Vector3<f64>, angle: f64| UnitQuaternion::new(axis.normalize() * angle);
    let axis = Vector3::new(1.0, -2.0, 0.5);
    let identity = UnitQuaternion::identity();
    assert!((rotation_distance(&identity, &about(axis, PI)) - 2.0).abs() < 1e-15);
    assert!((rotation_distance(&identity, &about(axis, FRAC_PI_2)) - SQRT_2).abs() < 1e-15);
    let small = rotation_distance(&about(axis, 1.0), &about(axis, 1.0 + 1e-6));
    assert!((small - 1e-6).abs() < 1e-15, "the angle itself, where it is small: {small}");
    let a = about(axis, 2.0);
    assert_eq!(rotation_distance(&a, &quaternion([-a.w, -a.i, -a.j, -a.k])), 0.0);
}

proptest! {
    #[test]
    fn rotation_vectors_come_back(
        direction in prop::array::uniform3(-1.0..1.0_f64),
        // From far below half a turn up to it, where the precision is worst.
        angle in prop_oneof![
            0.0..PI,
            (-300.0..0.0_f64).prop_map(|x| 10_f64.powf(x)),
            (-16.0..0.0_f64).prop_map(|x| PI - 10_f64.powf(x)),
        ],
    ) {
        let Some(axis) = unit_axis(direction) else { return Ok(()) };
        let vector = axis.into_inner() * angle;
        let back = Vector3::from(to_rotation_vector(&from_rotation_vector(vector.into())));
        // So close to half a turn that rounding exceeds it; the opposite vector is right too.
        let past = if angle > PI - 1e-15 { (back + vector).norm() } else { f64::MAX };
        let error = (back - vector).norm().min(past);
        prop_assert!(error <= 4e-15 * angle, "{} {}", vector, back);
        prop_assert!(back.norm() <= PI * (1.0 + 1e-15));
    }

    #[test]
    fn poses_come_back(
        position in prop::array::uniform3(-9.0..9.0_f64),
        v in prop::array::uniform3(-9.0..9.0_f64),
    ) {
        let isometry = Isometry3::from_parts(Translation3::from(position), from_rotation_vector(v));
        let pose = from_isometry(&isometry);
        prop_assert!(pose.quaternion_wxyz[0] >= 0.0);
        prop_assert_eq!(pose.position, position);
        let back = to_isometry(&pose).unwrap();
        prop_assert!(rotation_distance(&back.rotation, &isometry.rotation) < 4e-15);
    }

    #[test]
    fn fixed_axis_angles_are_a_product_of_three_turns(rpy in prop::array::uniform3(-7.0..7.0_f64)) {
        let found = from_rpy(rpy).to_rotation_matrix().into_inner();
        prop_assert!((found - naive_rpy(rpy)).amax() < 1e-14);
    }

    #[test]
    fn the_distance_is_twice_the_sine_of_half_the_angle(
        v in prop::array::uniform3(-1.8..1.8_f64),
        base in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let base = from_rotation_vector(base);
        let expected = 2.0 * (Vector3::from(v).norm() / 2.0).sin();
        let found = rotation_distance(&base, &(base * from_rotation_vector(v)));
        prop_assert!((found - expected).abs() < 4e-15, "{} {}", found, expected);
    }
}

#[test]
fn angles_keep_the_rotation_to_the_last_digits() {
    let near = [0.0, 1e-16, 1e-12, 1e-9, 1e-8, 2.7e-8, 1e-6, 1e-3, 0.3, 1.0];
    for pitch in near.iter().flat_map(|x| [FRAC_PI_2 - x, x - FRAC_PI_2, *x]) {
        for (roll, yaw) in [(0.0, 0.0), (0.3, -2.0), (-3.0, 3.1), (FRAC_PI_2, -FRAC_PI_2)] {
            let rotation = from_rpy([roll, pitch, yaw]);
            let again = from_rpy(to_rpy(rotation.to_rotation_matrix().matrix()));
            let apart = rotation_distance(&rotation, &again);
            assert!(apart < 4e-15, "{roll} {pitch} {yaw}: {apart:e}");
        }
    }
}
