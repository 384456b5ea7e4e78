//! Inverse kinematics, limits and masses over the border.

use std::ptr::{null, null_mut};

use nalgebra::{Point3, Vector3};
use urdd_c::Verdict::{Limits, OutOfReach, Reached, Refused, Unknown};
use urdd_c::*;
use urdd_robot::ShapeKind;

use crate::interface::{arm, fails, ok, open, samples};

#[test]
fn limits_and_masses_are_those_of_the_urdf() {
    let (handle, robot) = (open(), arm());
    let (mut velocity, mut effort, mut masses) = ([0.0; 6], [0.0; 6], [0.0; 36]);
    let q = samples(4);
    let mut centres = [0.0; 12];
    // SAFETY: as the header says.
    unsafe {
        ok(urdd_robot_velocity_limits(handle, velocity.as_mut_ptr(), 6));
        ok(urdd_robot_effort_limits(handle, effort.as_mut_ptr(), 6));
        ok(urdd_robot_link_masses(handle, masses.as_mut_ptr(), 36));
        ok(urdd_robot_centre_of_mass(handle, q.as_ptr(), 4, 6, centres.as_mut_ptr()));
        assert_eq!(urdd_robot_effort_limits(handle, effort.as_mut_ptr(), 5), Status::Length);
        assert_eq!(urdd_robot_link_masses(handle, masses.as_mut_ptr(), 35), Status::Length);
        ok(urdd_robot_free(handle));
    }
    // As in conformance/robots/welding_arm.urdf.
    assert_eq!(velocity, [2.6, 2.6, 2.8, 4.0, 4.0, 6.0]);
    assert_eq!(effort, [300.0, 300.0, 200.0, 60.0, 60.0, 30.0]);
    let (masses, _) = masses.as_chunks::<4>();
    let kilograms: Vec<f64> = masses.iter().map(|[mass, ..]| *mass).collect();
    assert_eq!(kilograms, [14.0, 8.0, 6.0, 4.0, 1.5, 0.5, 0.9, 0.2, 0.0]);
    assert_eq!(masses[1][1..], [0.0, 0.0, 0.12]);
    for (q, centre) in q.chunks(6).zip(centres.chunks(3)) {
        let poses = robot.link_poses(q).unwrap();
        let moments = poses
            .iter()
            .zip(masses)
            .map(|(pose, [mass, x, y, z])| (pose * Point3::new(*x, *y, *z)).coords * *mass);
        let expected = moments.sum::<Vector3<f64>>() / kilograms.iter().sum::<f64>();
        assert!((expected - Vector3::from_row_slice(centre)).norm() < 1e-12);
    }
}

#[test]
fn inverse_kinematics_has_weights_locks_postures_free_shapes_and_verdicts() {
    let (handle, robot, q) = (open(), arm(), samples(3));
    let torch = robot.link("torch").unwrap();
    let pose = |row: &[f64]| {
        let pose = robot.link_poses(row).unwrap()[torch];
        let pose = pose.to_homogeneous().transpose();
        <[f64; 16]>::try_from(pose.as_slice()).unwrap()
    };
    let mut target = Target {
        link: torch,
        pose: pose(&q[..6]),
        point: [0.0; 3],
        is_position: false,
        weights: [0.0; 6],
    };
    let mut proximity = null_mut();
    // SAFETY: as the header says.
    unsafe {
        let kind = c"pieces".as_ptr();
        ok(urdd_robot_proximity(handle, kind, &raw mut proximity));
        let mut settings = std::mem::zeroed::<Settings>();
        ok(urdd_inverse_settings_default(&raw mut settings));
        settings.explain = true;
        let ask = |target: &Target, settings: &Settings, start: &[f64]| {
            let (mut found, mut solution) = ([0.0; 6], Solution::default());
            let outputs = (found.as_mut_ptr(), &raw mut solution);
            let (start, at, out) = (start.as_ptr(), &raw const *settings, outputs);
            let status =
                urdd_robot_inverse_kinematics(handle, target, 1, start, 1, 6, at, out.0, out.1);
            (status, found, solution.verdict)
        };
        let start = [0.1, 0.2, -0.4, 0.3, 0.5, 0.6];
        // The rotation alone, wherever it is.
        target.weights = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
        target.pose[3] = 50.0;
        let (_, found, verdict) = ask(&target, &settings, &start);
        assert_eq!(verdict, Reached);
        let turn = robot.link_poses(&found).unwrap()[torch].rotation;
        let wished = robot.link_poses(&q[..6]).unwrap()[torch].rotation;
        assert!(turn.angle_to(&wished) < 2e-6);
        target.weights = [0.0; 6];
        assert_eq!(ask(&target, &settings, &start).2, OutOfReach);
        target.pose = pose(&q[..6]);
        // What is locked keeps its value, and the target is then beyond reach or limits.
        let locked = [1_usize, 4];
        (settings.locked, settings.locked_length) = (locked.as_ptr(), 2);
        let (_, found, verdict) = ask(&target, &settings, &start);
        assert_eq!((found[1], found[4]), (start[1], start[4]));
        assert!(matches!(verdict, OutOfReach | Limits), "{verdict:?}");
        (settings.locked, settings.locked_length) = (std::ptr::null(), 0);
        // From where it is not, the posture is found where it solves.
        (settings.posture, settings.posture_length) = (q.as_ptr(), 6);
        let (_, found, verdict) = ask(&target, &settings, &start);
        assert_eq!(verdict, Reached);
        let far = found.iter().zip(&q[..6]).map(|(a, b)| (a - b).abs());
        assert!(far.fold(0.0, f64::max) < 1e-4, "{found:?}");
        settings.posture_length = 5;
        assert_ne!(ask(&target, &settings, &start).0, Status::Ok);
        (settings.posture, settings.posture_length) = (std::ptr::null(), 0);
        // A solution is free, or refused.
        settings.free_of = proximity;
        let shapes = robot.proximity(ShapeKind::Pieces).unwrap();
        let mut verdicts = Vec::new();
        for k in 0..20 {
            let q = robot.configurations().unwrap().random(k);
            target.pose = pose(&q);
            let (_, found, verdict) = ask(&target, &settings, &start);
            let collides = shapes.in_collision(&found).unwrap();
            assert_eq!(collides, verdict == Refused, "{k} {verdict:?}");
            verdicts.push(verdict);
        }
        assert!(verdicts.contains(&Refused) && verdicts.contains(&Reached));
        ok(urdd_proximity_free(proximity));
        ok(urdd_robot_free(handle));
    }
}

#[test]
fn inverse_kinematics_reaches_a_pose_a_point_and_says_when_it_does_not() {
    let (handle, robot, q) = (open(), arm(), samples(4));
    let torch = robot.link("torch").unwrap();
    let target = |row: &[f64]| {
        let pose = robot.link_poses(row).unwrap()[torch].to_homogeneous().transpose();
        Target {
            link: torch,
            pose: pose.as_slice().try_into().unwrap(),
            point: [0.0; 3],
            is_position: false,
            weights: [0.0; 6],
        }
    };
    let mut targets: Vec<Target> = q.chunks(6).map(target).collect();
    targets[1].is_position = true;
    targets[2].pose[3] = 100.0;
    let (mut found, mut solutions) = ([0.0; 24], [Solution::default(); 4]);
    let start = [0.0; 6];
    // SAFETY: as the header says.
    unsafe {
        ok(urdd_robot_inverse_kinematics(
            handle,
            targets.as_ptr(),
            4,
            start.as_ptr(),
            1,
            6,
            null(),
            found.as_mut_ptr(),
            solutions.as_mut_ptr(),
        ));
        assert_eq!(solutions.map(|one| one.is_reached), [true, true, false, true]);
        for k in [0, 3] {
            let pose = robot.link_poses(&found[6 * k..6 * k + 6]).unwrap()[torch];
            let known = robot.link_poses(&q[6 * k..6 * k + 6]).unwrap()[torch];
            assert!((pose.translation.vector - known.translation.vector).norm() <= 1e-6);
            assert!(pose.rotation.angle_to(&known.rotation) <= 1.1e-6);
        }
        assert!(solutions[2].position_error > 90.0);
        let verdicts = [Reached, Reached, Unknown, Reached];
        assert_eq!(solutions.map(|one| one.verdict), verdicts);
        targets[0].pose[0] = 3.0;
        let outputs = (found.as_mut_ptr(), solutions.as_mut_ptr());
        let ask = |targets: &[Target], starts_rows| {
            let (at, count) = (targets.as_ptr(), targets.len());
            let start = start.as_ptr();
            urdd_robot_inverse_kinematics(
                handle,
                at,
                count,
                start,
                starts_rows,
                6,
                null(),
                outputs.0,
                outputs.1,
            )
        };
        fails(ask(&targets, 1), Status::Value, "pose of target 0");
        targets[0].pose[0] = f64::NAN;
        fails(ask(&targets, 1), Status::Value, "pose of target 0");
        targets[1].link = 99;
        fails(ask(&targets[1..], 1), Status::OutOfRange, "link 99");
        fails(ask(&targets[3..], 0), Status::Length, "`starts` has 0 rows");
        ok(urdd_robot_free(handle));
    }
}
