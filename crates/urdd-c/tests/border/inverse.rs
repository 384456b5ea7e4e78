//! Inverse kinematics, limits and masses over the border.

use std::ptr::{null, null_mut};

use nalgebra::{DVector, Point3, Vector3};
use urdd_c::Verdict::{Limits, OutOfReach, Reached, Refused, Unknown};
use urdd_c::*;
use urdd_robot::{Queries, ShapeKind};

use crate::interface::{arm, fails, ok, open, samples};

#[test]
fn limits_and_masses_are_those_of_the_urdf() {
    let (handle, robot) = (open(), arm());
    let (mut velocity, mut effort, mut masses) = ([0.0; 6], [0.0; 6], [0.0; 36]);
    let q = samples(4);
    let (mut centres, mut torques, mut loaded) = ([0.0; 12], [0.0; 24], [0.0; 24]);
    let (torch, point, up) = (robot.link("torch").unwrap(), [0.1, 0.0, -0.2], [0.0, 0.0, 9.81]);
    // SAFETY: as the header says.
    unsafe {
        ok(urdd_robot_velocity_limits(handle, velocity.as_mut_ptr(), 6));
        ok(urdd_robot_effort_limits(handle, effort.as_mut_ptr(), 6));
        ok(urdd_robot_link_masses(handle, masses.as_mut_ptr(), 36));
        ok(urdd_robot_centre_of_mass(handle, q.as_ptr(), 4, 6, centres.as_mut_ptr()));
        let hold = |gravity, payload, link, point, out: &mut [f64]| {
            let (out, length) = (out.as_mut_ptr(), out.len());
            urdd_robot_gravity_torques(
                handle,
                q.as_ptr(),
                4,
                6,
                gravity,
                payload,
                link,
                point,
                out,
                length,
            )
        };
        ok(hold(null(), 0.0, usize::MAX, null(), &mut torques));
        ok(hold(up.as_ptr(), 2.0, torch, point.as_ptr(), &mut loaded));
        let none = &mut [0.0; 24];
        assert_eq!(hold(null(), 0.0, 0, null(), &mut none[..23]), Status::Length);
        assert_eq!(hold(null(), -1.0, torch, null(), none), Status::Value);
        assert_eq!(hold([f64::NAN; 3].as_ptr(), 0.0, 0, null(), none), Status::Value);
        assert_eq!(hold(null(), 1.0, 9, null(), none), Status::OutOfRange);
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
    // By the Jacobian of each centre of mass.
    for (k, q) in q.chunks(6).enumerate() {
        let row = |link, at: &[f64]| {
            let at = [at[0], at[1], at[2]];
            robot.jacobian_at(q, link, at).unwrap().row(2).transpose()
        };
        let bodies = masses.iter().enumerate();
        let sum = bodies.fold(DVector::zeros(6), |sum, (link, [mass, at @ ..])| {
            sum + 9.81 * *mass * row(link, at)
        });
        let found = |all: &[f64]| DVector::from_row_slice(&all[6 * k..6 * k + 6]);
        assert!((found(&torques) - &sum).norm() < 1e-12);
        let lifted = -sum - 9.81 * 2.0 * row(torch, &point);
        assert!((found(&loaded) - lifted).norm() < 1e-12);
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

/// The welding arm, a target where it was, and what is asked of it.
struct Asked {
    robot: *mut Robot,
    target: Target,
    settings: Settings,
    start: [f64; 6],
}

impl Asked {
    fn new(q: &[f64]) -> Self {
        let (robot, arm) = (open(), arm());
        let link = arm.link("torch").unwrap();
        let pose = arm.link_poses(q).unwrap()[link].to_homogeneous().transpose();
        let pose = pose.as_slice().try_into().unwrap();
        let (point, weights) = ([0.0; 3], [0.0; 6]);
        let target = Target { link, pose, point, is_position: false, weights };
        // SAFETY: zeros are settings.
        let mut settings = unsafe { std::mem::zeroed() };
        // SAFETY: as the header says.
        ok(unsafe { urdd_inverse_settings_default(&mut settings) });
        Asked { robot, target, settings, start: [0.1, 0.2, -0.4, 0.3, 0.5, 0.6] }
    }

    fn ask(&self) -> (Status, [f64; 6], Verdict) {
        let (mut found, mut solution) = ([0.0; 6], Solution::default());
        // SAFETY: as the header says.
        let status = unsafe {
            let (robot, target, start) = (self.robot, &raw const self.target, self.start.as_ptr());
            let (found, solution) = (found.as_mut_ptr(), &raw mut solution);
            let settings = &raw const self.settings;
            urdd_robot_inverse_kinematics(robot, target, 1, start, 1, 6, settings, found, solution)
        };
        (status, found, solution.verdict)
    }
}

impl Drop for Asked {
    fn drop(&mut self) {
        // SAFETY: as the header says.
        ok(unsafe { urdd_robot_free(self.robot) });
    }
}

#[test]
fn solutions_are_free_of_obstacles_too() {
    let space = arm();
    let space = space.configurations().unwrap();
    let (mut proximity, mut world) = (null_mut(), null_mut());
    let mut asked = Asked::new(&space.zero());
    let (margin, mut verdicts) = (0.02, Vec::new());
    // SAFETY: as the header says.
    unsafe {
        ok(urdd_robot_proximity(asked.robot, c"pieces".as_ptr(), &raw mut proximity));
        let mut balls = [null_mut(); 2];
        for (ball, x) in balls.iter_mut().zip([0.45, -0.45]) {
            let centre = [x, 0.1, 0.5];
            ok(urdd_obstacle_sphere(c"ball".as_ptr(), centre.as_ptr(), 0.2, ball));
        }
        let balls = balls.map(|ball| ball.cast_const());
        ok(urdd_proximity_world_proximity(proximity, balls.as_ptr(), 2, &raw mut world));
        let mut plain_in_collision = 0;
        for k in 0..30 {
            asked.target = Asked::new(&space.random(k)).target;
            let margin_of = |q: &[f64; 6]| {
                let (mut distance, mut touches) = (0.0, false);
                let at = q.as_ptr();
                ok(urdd_world_proximity_min_distance(world, at, 1, 6, &raw mut distance));
                ok(urdd_proximity_in_collision(proximity, at, 1, 6, &raw mut touches));
                if touches { 0.0 } else { distance }
            };
            (asked.settings.free_of, asked.settings.free_of_world) = (null(), null());
            plain_in_collision += usize::from(margin_of(&asked.ask().1) <= margin);
            (asked.settings.free_of, asked.settings.free_of_world) = (proximity, world);
            asked.settings.margin = margin;
            let (status, q, verdict) = asked.ask();
            ok(status);
            assert_eq!(verdict == Reached, margin_of(&q) > margin, "{k} {verdict:?}");
            verdicts.push(verdict);
        }
        assert!(plain_in_collision > 5, "{plain_in_collision}");
        assert!(verdicts.contains(&Refused) && verdicts.contains(&Reached), "{verdicts:?}");
        for margin in [f64::NAN, -0.1, f64::INFINITY] {
            asked.settings.margin = margin;
            fails(asked.ask().0, Status::Value, "a margin");
        }
        ok(urdd_world_proximity_free(world));
        ok(urdd_proximity_free(proximity));
        for ball in balls {
            ok(urdd_obstacle_free(ball.cast_mut()));
        }
    }
}

#[test]
fn settings_that_make_no_sense_are_refused() {
    let q = samples(1);
    type Change = fn(&mut Asked);
    let changes: [(Change, Status, &str); 15] = [
        // SAFETY: zeros are settings.
        (|a| a.settings = unsafe { std::mem::zeroed() }, Status::Value, "`iterations` is 0"),
        (|a| a.settings.position_tolerance = f64::NAN, Status::Value, "a tolerance"),
        (|a| a.settings.position_tolerance = -1.0, Status::Value, "a tolerance"),
        (|a| a.settings.rotation_tolerance = f64::NAN, Status::Value, "a tolerance"),
        (|a| a.settings.rotation_tolerance = -1.0, Status::Value, "a tolerance"),
        (|a| a.target.weights[3] = f64::NAN, Status::Value, "a weight"),
        (|a| a.target.weights[3] = -1.0, Status::Value, "a weight"),
        (|a| a.target.point[1] = f64::NAN, Status::Value, "not finite"),
        (|a| a.settings.posture = a.start.as_ptr(), Status::Length, "`posture_length` is 0"),
        (|a| a.settings.posture_length = 6, Status::Length, "`posture_length` is 6"),
        (|a| a.settings.bounds = a.start.as_ptr(), Status::Length, "`bounds_length` is 0"),
        (|a| a.settings.bounds_length = 12, Status::Length, "`bounds_length` is 12"),
        (|a| a.settings.locked_length = 1, Status::Pointer, "`locked` is null"),
        (
            |a| {
                (a.settings.locked, a.settings.locked_length) = (SEVEN.as_ptr(), 7);
            },
            Status::Length,
            "`locked_length` is 7",
        ),
        (
            |a| {
                (a.settings.bounds, a.settings.bounds_length) = (CROSSED.as_ptr(), 12);
            },
            Status::Value,
            "above its upper",
        ),
    ];
    for (change, status, words) in changes {
        let mut asked = Box::new(Asked::new(&q));
        ok(asked.ask().0);
        change(&mut asked);
        fails(asked.ask().0, status, words);
    }
}

const SEVEN: [usize; 7] = [0; 7];
const CROSSED: [f64; 12] = [-1.0, 1.0, -1.0, 1.0, 0.5, -0.5, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0];

/// No output may be where an input or the other output is.
#[test]
fn arrays_that_overlap_are_refused() {
    let q = samples(1);
    let mut asked = Box::new(Asked::new(&q));
    let mut values = [0.1; 64];
    let locked = [5_usize; 6];
    let (at, mut solution) = (values.as_mut_ptr(), Solution::default());
    let bounds: [f64; 12] = std::array::from_fn(|k| if k % 2 == 0 { -3.0 } else { 3.0 });
    values[32..44].copy_from_slice(&bounds);
    // SAFETY: as the header says; all are within their arrays.
    unsafe {
        asked.settings.locked = locked.as_ptr();
        asked.settings.locked_length = 1;
        (asked.settings.posture, asked.settings.posture_length) = (at.add(16), 6);
        (asked.settings.bounds, asked.settings.bounds_length) = (at.add(32), 12);
        let robot = asked.robot;
        let (target, settings) = (&raw mut asked.target, &raw mut asked.settings);
        let ask = |found: *mut f64, solution: *mut Solution| {
            urdd_robot_inverse_kinematics(robot, target, 1, at, 1, 6, settings, found, solution)
        };
        ok(ask(at.add(48), &raw mut solution));
        for (found, words) in [
            (at.add(5), "`configurations` and `starts`"),
            (at.add(20), "`configurations` and `posture`"),
            (at.add(27), "`configurations` and `bounds`"),
            (target.cast::<f64>().add(2), "`configurations` and `targets`"),
            (settings.cast(), "`configurations` and `settings`"),
            (locked.as_ptr().cast_mut().cast(), "`configurations` and `locked`"),
            ((&raw mut solution).cast(), "`configurations` and `solutions`"),
        ] {
            fails(ask(found, &raw mut solution), Status::Pointer, words);
        }
        for (solution, words) in [
            (at.add(3).cast(), "`solutions` and `starts`"),
            (at.add(18).cast(), "`solutions` and `posture`"),
            (at.add(40).cast(), "`solutions` and `bounds`"),
            (target.cast(), "`solutions` and `targets`"),
        ] {
            fails(ask(at.add(48), solution), Status::Pointer, words);
        }
    }
}

#[test]
fn a_continuous_joint_follows_without_a_jump_and_says_that_it_is_not_limited() {
    let mut limited = [false; 6];
    let mut asked = Asked::new(&[0.0; 6]);
    // SAFETY: as the header says.
    unsafe {
        ok(urdd_robot_dof_is_limited(asked.robot, limited.as_mut_ptr(), 6));
        let short = urdd_robot_dof_is_limited(asked.robot, limited.as_mut_ptr(), 5);
        fails(short, Status::Length, "`limited`");
    }
    // As in conformance/robots/welding_arm.urdf: axis_6 is continuous.
    assert_eq!(limited, [true, true, true, true, true, false]);
    asked.start[5] = 3.0;
    for k in 0..100 {
        let mut wanted = [0.1, 0.2, -0.4, 0.3, 0.5, 3.0];
        wanted[5] += 0.05 * f64::from(k);
        asked.target = Asked::new(&wanted).target;
        let (status, q, _) = asked.ask();
        ok(status);
        assert!((q[5] - wanted[5]).abs() < 1e-4, "{q:?}");
        asked.start = q;
    }
}
