//! Rotations and in-plane bases: by the consumer's kinematics and by the validator's own.

use nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};
use serde::Deserialize;
use urdd_document::pose::{rotation_of_quaternion, rotation_of_rpy};
use urdd_kinematics::rotation::{
    canonical, from_rotation_vector, from_rpy, planar_basis, rotation_distance, to_rotation_vector,
    unit_axis,
};
use urdd_validate::reference::{MimicDofs, Reference};

use super::{assert_near, vectors};

const TOLERANCE: f64 = 2e-15;

#[derive(Deserialize)]
struct Rotations {
    rpy: Vec<OfAngles>,
    gimbal_lock: Vec<Same>,
    canonical: Vec<Canonical>,
    rotation_vectors: Vec<OfVector>,
}

#[derive(Deserialize)]
struct OfAngles {
    rpy: [f64; 3],
    quaternion_wxyz: [f64; 4],
}

#[derive(Deserialize)]
struct Same {
    rpy: [f64; 3],
    same_as_rpy: [f64; 3],
    quaternion_wxyz: [f64; 4],
}

#[derive(Deserialize)]
struct Canonical {
    quaternion_wxyz: [f64; 4],
    canonical_wxyz: [f64; 4],
}

#[derive(Deserialize)]
struct OfVector {
    rotation_vector: [f64; 3],
    quaternion_wxyz: [f64; 4],
}

fn quaternion([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z))
}

fn wxyz(q: &UnitQuaternion<f64>) -> [f64; 4] {
    [q.w, q.i, q.j, q.k]
}

/// As rotations; and as quaternions if w is clear of 0, so that its sign is not noise.
#[track_caller]
fn assert_rotation(found: &UnitQuaternion<f64>, expected: [f64; 4], place: &str) {
    let distance = rotation_distance(found, &quaternion(expected));
    assert!(distance < TOLERANCE, "{place}: {distance:e} off");
    if expected[0] > TOLERANCE {
        assert_near(&wxyz(&canonical(found)), &expected, TOLERANCE, place);
    }
}

fn assert_matrix(found: &Matrix3<f64>, expected: [f64; 4], place: &str) {
    let expected = quaternion(expected).to_rotation_matrix().into_inner();
    assert_near(found.as_slice(), expected.as_slice(), TOLERANCE, place);
}

#[test]
fn roll_pitch_yaw() {
    let rotations: Rotations = vectors("rotations.json");
    assert!(rotations.rpy.len() > 10);
    for case in rotations.rpy {
        let place = format!("rpy {:?}", case.rpy);
        assert_rotation(&from_rpy(case.rpy), case.quaternion_wxyz, &place);
        assert_matrix(&rotation_of_rpy(case.rpy), case.quaternion_wxyz, &place);
        assert_matrix(&rotation_of_quaternion(case.quaternion_wxyz), case.quaternion_wxyz, &place);
    }
    assert!(!rotations.gimbal_lock.is_empty());
    for case in rotations.gimbal_lock {
        for rpy in [case.rpy, case.same_as_rpy] {
            let place = format!("rpy {rpy:?}");
            assert_rotation(&from_rpy(rpy), case.quaternion_wxyz, &place);
            assert_matrix(&rotation_of_rpy(rpy), case.quaternion_wxyz, &place);
        }
    }
}

#[test]
fn quaternions_have_one_sign() {
    let rotations: Rotations = vectors("rotations.json");
    assert!(!rotations.canonical.is_empty());
    for case in rotations.canonical {
        let found = canonical(&quaternion(case.quaternion_wxyz));
        assert_eq!(wxyz(&found), case.canonical_wxyz);
    }
}

#[test]
fn rotation_vectors() {
    let rotations: Rotations = vectors("rotations.json");
    assert!(!rotations.rotation_vectors.is_empty());
    for case in rotations.rotation_vectors {
        let place = format!("rotation vector {:?}", case.rotation_vector);
        let found = from_rotation_vector(case.rotation_vector);
        assert_rotation(&found, case.quaternion_wxyz, &place);
        let angle = Vector3::from(case.rotation_vector).norm();
        // Back again, where it is the only vector of its rotation.
        if angle < 3.1 {
            let back = to_rotation_vector(&quaternion(case.quaternion_wxyz));
            assert_near(&back, &case.rotation_vector, TOLERANCE * (1.0 + angle), &place);
        }
    }
}

#[derive(Deserialize)]
struct Bases {
    bases: Vec<Basis>,
}

#[derive(Deserialize)]
struct Basis {
    axis: [f64; 3],
    unit_axis: [f64; 3],
    x: [f64; 3],
    y: [f64; 3],
}

#[test]
fn in_plane_bases() {
    let bases: Bases = vectors("in_plane_bases.json");
    assert!(bases.bases.len() > 10);
    for case in bases.bases {
        let place = format!("axis {:?}", case.axis);
        let axis: Unit<Vector3<f64>> = unit_axis(case.axis).unwrap();
        assert_near(axis.as_slice(), &case.unit_axis, TOLERANCE, &place);
        let [x, y] = planar_basis(&axis);
        assert_near(x.as_slice(), &case.x, TOLERANCE, &place);
        assert_near(y.as_slice(), &case.y, TOLERANCE, &place);
        // The validator's reference, which reads a URDF.
        let [i, j, k] = case.axis;
        let urdf = format!(
            r#"<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="planar"><parent link="a"/><child link="b"/><axis xyz="{i} {j} {k}"/></joint></robot>"#
        );
        let reference = Reference::new(
            &urdd_validate::urdf_text::read(&urdf).robot.unwrap(),
            MimicDofs::Follow,
        )
        .unwrap();
        for (q, expected) in [([1.0, 0.0, 0.0], case.x), ([0.0, 1.0, 0.0], case.y)] {
            let poses = reference.link_poses(&q).unwrap();
            let found = poses[1].translation.vector;
            assert_near(found.as_slice(), &expected, TOLERANCE, &place);
        }
        let about = Rotation3::from_axis_angle(&axis, 0.5);
        let poses = reference.link_poses(&[0.0, 0.0, 0.5]).unwrap();
        let found = poses[1].rotation.to_rotation_matrix();
        assert_near(found.matrix().as_slice(), about.matrix().as_slice(), TOLERANCE, &place);
    }
}
