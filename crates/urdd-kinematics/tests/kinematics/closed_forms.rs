//! Forward kinematics, compared with values calculated by hand.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI};

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};
use urdd_format::index::LinkIdx;
use urdd_format::urdf::JointType::{self, *};
use urdd_kinematics::{ConfigurationError, ForwardKinematics};

use testkit::core_modules::{Joint, chain_of, core_modules};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

fn poses(joints: &[Joint], q: &[f64]) -> Vec<Isometry3<f64>> {
    let (chain, dof) = chain_of(joints);
    ForwardKinematics::new(&chain, &dof).unwrap().link_poses(q).unwrap()
}

/// Pose of the child link of a single joint at the root's origin.
fn pose(joint_type: JointType, axis: [f64; 3], q: &[f64]) -> Isometry3<f64> {
    poses(&[Joint::after(0, joint_type, axis)], q)[1]
}

#[track_caller]
fn assert_point(pose: &Isometry3<f64>, point: [f64; 3], expected: [f64; 3]) {
    let found = pose * Point3::from(point);
    let difference = (found - Point3::from(expected)).norm();
    assert!(difference < 1e-14, "{point:?} is taken to {found:?}, not to {expected:?}");
}

#[test]
fn a_revolute_joint_turns_by_the_right_hand() {
    for joint_type in [Revolute, Continuous] {
        let pose = pose(joint_type, Z, &[FRAC_PI_2]);
        assert_point(&pose, X, Y);
        assert_point(&pose, Y, [-1.0, 0.0, 0.0]);
        assert_point(&pose, Z, Z);
    }
}

#[test]
fn a_prismatic_joint_slides_along_its_axis_and_does_not_turn() {
    let pose = pose(Prismatic, [3.0, 0.0, -4.0], &[0.5]);
    assert_point(&pose, [0.0; 3], [0.3, 0.0, -0.4]);
    assert_point(&pose, X, [1.3, 0.0, -0.4]);
}

#[test]
fn a_joint_moves_in_its_own_frame() {
    // Fixed, a quarter turn about x: the second joint's z is then the root's -y.
    let joints = [
        Joint::after(0, Fixed, X).at([1.0, 2.0, 3.0], [FRAC_PI_2, 0.0, 0.0]),
        Joint::after(1, Revolute, Z).at([0.0, 0.0, 1.0], [0.0; 3]),
    ];
    let poses = poses(&joints, &[FRAC_PI_2]);
    assert_eq!(poses[0], Isometry3::identity());
    assert_point(&poses[1], [0.0; 3], [1.0, 2.0, 3.0]);
    assert_point(&poses[2], [0.0; 3], [1.0, 1.0, 3.0]);
    assert_point(&poses[2], X, [1.0, 1.0, 4.0]);
}

#[test]
fn a_planar_joint_slides_first_and_then_turns() {
    let pose = pose(Planar, Z, &[0.1, 0.2, FRAC_PI_2]);
    assert_point(&pose, [0.0; 3], [0.1, 0.2, 0.0]);
    assert_point(&pose, X, [0.1, 1.2, 0.0]);
}

#[test]
fn a_planar_joint_about_x_has_minus_z_for_its_first_direction() {
    // The arc from z to x is a quarter turn about y: x goes to -z, y stays.
    let pose = pose(Planar, X, &[0.1, 0.2, FRAC_PI_2]);
    assert_point(&pose, [0.0; 3], [0.0, 0.2, -0.1]);
    assert_point(&pose, Y, [0.0, 0.2, 0.9]);
}

#[test]
fn a_planar_joint_about_an_oblique_axis() {
    // Axis (1, 2, 2)/3: x' = (1 - ax^2/(1+az), -ax ay/(1+az), -ax) and so on.
    let along_x = pose(Planar, [1.0, 2.0, 2.0], &[15.0, 0.0, 0.0]);
    assert_point(&along_x, [0.0; 3], [14.0, -2.0, -5.0]);
    let along_y = pose(Planar, [1.0, 2.0, 2.0], &[0.0, 15.0, 0.0]);
    assert_point(&along_y, [0.0; 3], [-2.0, 11.0, -10.0]);
    // Half a turn about a takes p to 2 (a.p) a - p.
    let turned = pose(Planar, [1.0, 2.0, 2.0], &[0.0, 0.0, PI]);
    assert_point(&turned, [9.0, 0.0, 0.0], [-7.0, 4.0, 4.0]);
}

#[test]
fn a_planar_joint_about_minus_z_has_x_and_minus_y() {
    let pose = pose(Planar, [0.0, 0.0, -1.0], &[0.1, 0.2, FRAC_PI_2]);
    assert_point(&pose, [0.0; 3], [0.1, -0.2, 0.0]);
    assert_point(&pose, X, [0.1, -1.2, 0.0]);
}

#[test]
fn a_planar_joint_near_minus_z_keeps_an_orthonormal_basis() {
    for tilt in [1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 2e-10] {
        for angle in [0.3_f64, 2.0, 4.0] {
            let axis = [tilt * angle.cos(), tilt * angle.sin(), -1.0];
            let a = Vector3::from(axis).normalize();
            let x = pose(Planar, axis, &[1.0, 0.0, 0.0]).translation.vector;
            let y = pose(Planar, axis, &[0.0, 1.0, 0.0]).translation.vector;
            let basis = Matrix3::from_columns(&[x, y, a]);
            assert!((basis.transpose() * basis - Matrix3::identity()).norm() < 1e-14, "{axis:?}");
            assert!((basis.determinant() - 1.0).abs() < 1e-14, "{axis:?}");
            // The arc leaves the direction perpendicular to it unchanged.
            let still = Vector3::new(-angle.sin(), angle.cos(), 0.0);
            assert!((basis * still - still).norm() < 1e-14, "{axis:?}");
        }
    }
    let within = pose(Planar, [1e-11, 1e-11, -1.0], &[0.1, 0.2, 0.0]);
    assert_point(&within, [0.0; 3], [0.1, -0.2, 0.0]);
}

#[test]
fn a_floating_joint_does_not_couple_translation_and_rotation() {
    let pose = pose(Floating, X, &[1.0, 2.0, 3.0, 0.0, 0.0, FRAC_PI_2]);
    assert_point(&pose, [0.0; 3], [1.0, 2.0, 3.0]);
    assert_point(&pose, X, [1.0, 3.0, 3.0]);
}

#[test]
fn a_spherical_joint_takes_a_rotation_vector() {
    // A third of a turn about (1, 1, 1) takes x to y, y to z.
    let third = 2.0 * PI / 3.0 / 3.0_f64.sqrt();
    let thirds = pose(Spherical, X, &[third; 3]);
    assert_point(&thirds, X, Y);
    assert_point(&thirds, Y, Z);
    // Half a turn, and both vectors of it.
    let half = PI * FRAC_1_SQRT_2;
    for sign in [1.0, -1.0] {
        let pose = pose(Spherical, X, &[sign * half, sign * half, 0.0]);
        assert_point(&pose, X, Y);
        assert_point(&pose, Z, [0.0, 0.0, -1.0]);
    }
    assert_eq!(pose(Spherical, X, &[0.0; 3]), Isometry3::identity());
}

#[test]
fn a_tiny_rotation_vector_is_not_lost() {
    for size in [1e-5, 1e-9, 1e-17, 1e-200] {
        let pose = pose(Spherical, X, &[0.0, 2.0 * size, -size]);
        let q = pose.rotation.quaternion();
        assert_eq!((q.w, q.i), ((size * 5.0_f64.sqrt() / 2.0).cos(), 0.0));
        assert!((q.j / size - 1.0).abs() < 1e-10 && (q.k / size + 0.5).abs() < 1e-10, "{q}");
    }
}

#[test]
fn mimic_joints_follow_their_dof_by_factor_and_offset() {
    let joints = [
        Joint::after(0, Prismatic, X),
        Joint::after(1, Prismatic, Y).follows(Some(0), -2.0, 0.25),
        Joint::after(2, Revolute, Z).follows(Some(0), PI, 0.0),
        Joint::after(3, Prismatic, Z).follows(None, 7.0, 0.125),
        Joint::after(4, Fixed, Z).follows(Some(0), 1.0, 1.0),
    ];
    let poses = poses(&joints, &[0.5]);
    assert_point(&poses[2], [0.0; 3], [0.5, -0.75, 0.0]);
    assert_point(&poses[3], X, [0.5, 0.25, 0.0]);
    assert_point(&poses[4], [0.0; 3], [0.5, -0.75, 0.125]);
    assert_eq!(poses[5], poses[4], "a fixed joint has no position to follow with");
}

#[test]
fn the_order_comes_from_the_joints() {
    // Links and joints listed from the tip up, and an empty hierarchy.
    let joint = |parent, child| Joint { child, ..Joint::after(parent, Prismatic, X) };
    let names = ["tip", "middle", "root"].map(str::to_owned);
    let (mut chain, dof) = core_modules(&names, &[joint(1, 0), joint(2, 1)]);
    chain.kinematic_hierarchy = vec![vec![LinkIdx(77)]];
    let kinematics = ForwardKinematics::new(&chain, &dof).unwrap();
    let poses = kinematics.link_poses(&[1.0, 10.0]).unwrap();
    let xs: Vec<f64> = poses.iter().map(|pose| pose.translation.x).collect();
    assert_eq!(xs, [11.0, 10.0, 0.0]);
    assert_eq!((kinematics.num_links(), kinematics.num_dofs()), (3, 2));
    assert_eq!(kinematics.root(), 2);
}

#[test]
fn a_buffer_is_filled_anew() {
    let (chain, dof) = chain_of(&[Joint::after(0, Revolute, Z)]);
    let kinematics = ForwardKinematics::new(&chain, &dof).unwrap();
    let mut buffer = vec![Isometry3::translation(9.0, 9.0, 9.0); 5];
    kinematics.link_poses_into(&[0.5], &mut buffer).unwrap();
    assert_eq!(buffer, kinematics.link_poses(&[0.5]).unwrap());
    assert!(kinematics.link_poses_into(&[], &mut buffer).is_err());
    assert!(buffer.is_empty(), "poses of another configuration must not be taken for these");
}

#[test]
fn a_configuration_without_poses_says_what_is_wrong() {
    let (chain, dof) = chain_of(&[Joint::after(0, Prismatic, X), Joint::after(1, Prismatic, X)]);
    let kinematics = ForwardKinematics::new(&chain, &dof).unwrap();
    let error = |q: &[f64]| kinematics.link_poses(q).unwrap_err();
    assert_eq!(error(&[0.0]), ConfigurationError::Length { expected: 2, found: 1 });
    assert!(matches!(error(&[0.0, f64::NAN]), ConfigurationError::NotFinite { dof_idx: 1, .. }));
    assert_eq!(error(&[1.5e308, 1.5e308]), ConfigurationError::Overflow { link_idx: 2 });
}
