//! Inverse kinematics, against closed forms and against forward kinematics.

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use urdd_robot::{Inverse, InverseSettings, Robot, RobotError, Target, Verdict};

use testkit::robots::{made, made_of, our_robots};

/// A planar arm with two links of 0.5 m and 0.3 m whose elbow bends one way, and a finger that follows the elbow.
const PLANAR: &str = r#"<robot name="planar">
  <link name="base"/><link name="upper"/><link name="fore"/><link name="tip"/><link name="finger"/><link name="lid"/>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0.5 0 0"/>
    <axis xyz="0 0 1"/><limit lower="0" upper="2.5" effort="1" velocity="1"/></joint>
  <joint name="hand" type="fixed"><parent link="fore"/><child link="tip"/><origin xyz="0.3 0 0"/></joint>
  <joint name="finger" type="prismatic"><parent link="tip"/><child link="finger"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/><mimic joint="elbow" multiplier="0.1" offset="0.02"/></joint>
  <joint name="lid" type="revolute"><parent link="base"/><child link="lid"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>"#;

fn ask(robot: &Robot, target: Target, start: &[f64]) -> Inverse {
    robot.inverse_kinematics(&target, start, &InverseSettings::default()).unwrap()
}

#[test]
fn a_planar_arm_as_the_textbook_has_it() {
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    let tip = robot.link("tip").unwrap();
    for angle in [0.0, 1.0, 2.0, 3.0, -2.5] {
        for reach in [0.35, 0.5, 0.7, 0.79] {
            let (x, y) = (reach * f64::cos(angle), reach * f64::sin(angle));
            let found = ask(&robot, Target::position(tip, [x, y, 0.0]), &[3.0, 0.1, 0.4]);
            let q = found.reached().expect("within reach").configuration;
            // The law of cosines, and the one elbow that the bounds leave.
            let elbow = f64::acos((reach * reach - 0.25 - 0.09) / (2.0 * 0.5 * 0.3));
            let behind = f64::atan2(0.3 * f64::sin(elbow), 0.5 + 0.3 * f64::cos(elbow));
            assert!((q[1] - elbow).abs() < 1e-4, "{q:?}, {elbow}");
            let off = (q[0] - (angle - behind)).rem_euclid(std::f64::consts::TAU);
            assert!(off.min(std::f64::consts::TAU - off) < 1e-4, "{q:?}");
            // The shoulder is not limited: half a turn from its start.
            assert!((q[0] - 3.0).abs() <= std::f64::consts::PI);
            // The lid does not move the tip.
            assert_eq!(q[2], 0.4);
        }
    }
}

#[test]
fn what_is_out_of_reach_is_approached() {
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    let tip = robot.link("tip").unwrap();
    // Stretched out, and 1.2 m short.
    let found = ask(&robot, Target::position(tip, [0.0, 2.0, 0.0]), &[0.3, 1.0, 0.0]);
    assert!(!found.is_reached());
    let nearest = found.nearest();
    assert!((nearest.position_error - 1.2).abs() < 1e-4, "{nearest:?}");
    assert!(nearest.configuration[1] < 0.02, "{nearest:?}");
    let there = robot.link_poses(&nearest.configuration).unwrap()[tip];
    let off = (there.translation.vector - Vector3::new(0.0, 2.0, 0.0)).norm();
    assert!((off - nearest.position_error).abs() < 1e-12);
    // The arm cannot rotate about x: a quarter turn remains.
    let turned = Isometry3::from_parts(
        Translation3::new(0.5, 0.3, 0.0),
        UnitQuaternion::from_euler_angles(std::f64::consts::FRAC_PI_2, 0.0, 0.0),
    );
    let found = ask(&robot, Target::pose(tip, turned), &[0.3, 1.0, 0.0]);
    assert!(!found.is_reached() && found.nearest().rotation_error > 1.5, "{found:?}");
    // A link that no DOF moves stays in place.
    let base = robot.link("base").unwrap();
    assert!(ask(&robot, Target::position(base, [0.0; 3]), &[0.0; 3]).is_reached());
    let found = ask(&robot, Target::position(base, [0.0, 0.0, 1.0]), &[0.0; 3]);
    assert_eq!(found.nearest().position_error, 1.0);
}

#[test]
fn bounds_hold_and_may_be_others() {
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    let tip = robot.link("tip").unwrap();
    let target = Target::position(tip, [0.5, 0.0, 0.0]);
    let pi = std::f64::consts::PI;
    let elbow = |bounds: [f64; 2]| {
        let settings = InverseSettings {
            bounds: Some(vec![[-pi, pi], bounds, [0.0, 0.0]]),
            ..InverseSettings::default()
        };
        robot.inverse_kinematics(&target, &[0.0; 3], &settings).unwrap()
    };
    // The elbow bent the other way, which the robot's own bounds forbid.
    let q = elbow([-2.5, 0.0]).reached().unwrap().configuration;
    assert!((-2.5..-1.0).contains(&q[1]), "{q:?}");
    // Bounded too straight: 0.3 m and 0.5 m bent by 0.5 rad reach farther than 0.5 m.
    let found = elbow([0.0, 0.5]);
    let reach = f64::sqrt(0.34 + 0.3 * f64::cos(0.5));
    assert!(!found.is_reached());
    assert!((found.nearest().position_error - (reach - 0.5)).abs() < 1e-6, "{found:?}");
    assert_eq!(found.nearest().configuration[1], 0.5);
}

#[test]
fn every_pose_of_every_robot_is_found_again() {
    let mut asked = 0;
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).unwrap();
        let space = robot.configurations().unwrap();
        for link in 0..robot.link_names().unwrap().len() {
            for k in 0..6 {
                // Numbers that no restart begins with.
                let wanted = space.random((1 << 20) + k);
                let pose = robot.link_poses(&wanted).unwrap()[link];
                let point = [0.1, -0.05, 0.2];
                let place: [f64; 3] = (pose * Point3::from(point)).coords.into();
                let tool = Isometry3::from_parts(Translation3::from(place), pose.rotation);
                let start = space.random((1 << 21) + k);
                for target in [
                    Target::pose(link, pose),
                    Target::pose(link, tool).of_point(point),
                    Target::position(link, place).of_point(point),
                ] {
                    let found = ask(&robot, target, &start);
                    assert_eq!(found, ask(&robot, target, &start), "the same answer again");
                    let found = found.reached().unwrap_or_else(|| panic!("{name}, {link}, {k}"));
                    let q = &found.configuration;
                    let within = |dof: usize| match space.dof_is_limited()[dof] {
                        true => (space.bounds()[dof][0]..=space.bounds()[dof][1]).contains(&q[dof]),
                        // A rotation vector can be turned by a whole turn.
                        false => (q[dof] - start[dof]).abs() <= std::f64::consts::TAU,
                    };
                    assert!((0..q.len()).all(within), "{name}, {link}, {k}: {q:?}");
                    let there = robot.link_poses(q).unwrap()[link];
                    let of_point = Target::position(link, place).of_point(point) == target;
                    let off = (there * Point3::from(point) - pose * Point3::from(point)).norm();
                    assert!(off < 2e-6, "{name}, {link}, {k}: {off}");
                    let turned = there.rotation.angle_to(&pose.rotation);
                    assert!(of_point || turned < 2e-6, "{name}, {link}, {k}: {turned}");
                    asked += 1;
                }
            }
        }
    }
    assert!(asked > 1000, "{asked}");
}

#[test]
fn questions_that_are_none() {
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    let settings = InverseSettings::default();
    let ask = |target: Target, start: &[f64], settings: &InverseSettings| {
        robot.inverse_kinematics(&target, start, settings)
    };
    let there = Target::position(3, [0.0; 3]);
    assert_eq!(
        ask(Target::position(9, [0.0; 3]), &[0.0; 3], &settings),
        Err(RobotError::OutOfRange { what: "link", index: 9, count: 6 })
    );
    let nowhere = Target::position(3, [0.0, f64::NAN, 0.0]);
    assert!(matches!(ask(nowhere, &[0.0; 3], &settings), Err(RobotError::Target(_))));
    let infinite = there.of_point([f64::INFINITY, 0.0, 0.0]);
    assert!(matches!(ask(infinite, &[0.0; 3], &settings), Err(RobotError::Target(_))));
    assert!(matches!(ask(there, &[0.0; 2], &settings), Err(RobotError::Configuration(_))));
    assert!(matches!(
        ask(there, &[0.0, f64::NAN, 0.0], &settings),
        Err(RobotError::Configuration(_))
    ));
    for bounds in [vec![[0.0, 1.0]; 2], vec![[0.0, f64::INFINITY]; 3]] {
        let settings = InverseSettings { bounds: Some(bounds), ..InverseSettings::default() };
        assert!(matches!(ask(there, &[0.0; 3], &settings), Err(RobotError::Target(_))));
    }
    // Numbers at the end of the range: no answer, and no panic.
    let far = Target::position(3, [1e308, -1e308, 1e308]);
    assert!(!ask(far, &[0.0; 3], &settings).unwrap().is_reached());
    let none = InverseSettings { restarts: 0, iterations: 1, ..settings };
    assert!(!ask(Target::position(3, [0.1, 0.2, 0.0]), &[0.0; 3], &none).unwrap().is_reached());
}

#[test]
fn settings_that_make_no_sense_are_refused() {
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    let there = Target::position(3, [0.5, 0.3, 0.0]);
    type Change = fn(&mut InverseSettings);
    let changes: [(Change, &str); 8] = [
        (|s| s.position_tolerance = f64::NAN, "a tolerance"),
        (|s| s.position_tolerance = -1.0, "a tolerance"),
        (|s| s.rotation_tolerance = f64::NAN, "a tolerance"),
        (|s| s.rotation_tolerance = -1e-300, "a tolerance"),
        (|s| s.iterations = 0, "`iterations` is 0"),
        (|s| s.bounds = Some(vec![[0.0, 1.0], [2.0, 1.0], [0.0, 1.0]]), "a lower bound is above"),
        (|s| s.bounds = Some(vec![[0.0, f64::NAN]; 3]), "a bound is not finite"),
        (|s| s.bounds = Some(Vec::new()), "one pair for each DOF"),
    ];
    for (change, words) in changes {
        let mut settings = InverseSettings::default();
        change(&mut settings);
        let found = robot.inverse_kinematics(&there, &[0.0; 3], &settings);
        let Err(RobotError::Target(said)) = found else {
            panic!("{settings:?}: {found:?}");
        };
        assert!(said.contains(words), "{said}");
    }
    for posture in [vec![0.0; 2], vec![f64::NAN; 3], vec![0.0, f64::INFINITY, 0.0]] {
        let settings = InverseSettings { posture: Some(posture), ..InverseSettings::default() };
        let found = robot.inverse_kinematics(&there, &[0.0; 3], &settings);
        assert!(matches!(found, Err(RobotError::Configuration(_))), "{found:?}");
    }
    // Nothing is left to reach: a position's weights of the rotation do not count.
    for weights in [[0.0; 6], [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]] {
        let settings = InverseSettings::default();
        let found = robot.inverse_kinematics(&there.weighted(weights), &[0.0; 3], &settings);
        assert!(matches!(found, Err(RobotError::Target(_))), "{found:?}");
    }
}

/// The tip goes three times around the base, each way: its angle grows with it.
#[test]
fn a_continuous_joint_follows_without_a_jump() {
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    let space = robot.configurations().unwrap();
    assert_eq!(space.dof_is_limited(), [false, true, true]);
    let tip = robot.link("tip").unwrap();
    for posture in [None, Some(())] {
        for way in [1.0, -1.0] {
            let mut q = vec![0.0, 1.0, 0.0];
            let begin = robot.link_poses(&q).unwrap()[tip];
            for k in 1..=600 {
                let angle = way * f64::from(k) * std::f64::consts::TAU / 200.0;
                let pose = UnitQuaternion::from_euler_angles(0.0, 0.0, angle) * begin;
                // A posture is where it was: the nearest solution is the next.
                let posture = posture.map(|()| q.clone());
                let settings = InverseSettings { posture, ..InverseSettings::default() };
                let found = robot.inverse_kinematics(&Target::pose(tip, pose), &q, &settings);
                q = found.unwrap().reached().expect("reached").configuration;
                assert!((q[0] - angle).abs() < 1e-4 && (q[1] - 1.0).abs() < 1e-4, "{q:?}");
            }
        }
    }
    // What is not reached does not jump either.
    let far = Target::position(tip, [-9.0, -0.1, 0.0]);
    let q = ask(&robot, far, &[3.1, 0.1, 0.0]).nearest().configuration.clone();
    assert!((q[0] - 3.15).abs() < 0.1, "{q:?}");
    // Given bounds bind it.
    let bounds = Some(vec![[-3.1, 3.1], [0.0, 2.5], [-1.0, 1.0]]);
    let settings = InverseSettings { bounds, ..InverseSettings::default() };
    let there = robot.link_poses(&[3.2, 1.0, 0.0]).unwrap()[tip];
    let found = robot.inverse_kinematics(&Target::pose(tip, there), &[2.9, 1.0, 0.0], &settings);
    let q = found.unwrap().reached().expect("reached").configuration;
    assert!((q[0] - (3.2 - std::f64::consts::TAU)).abs() < 1e-5, "{q:?}");
}

/// A base that drives and turns, and a body that turns every way.
#[test]
fn what_is_not_limited_follows_from_where_it_is() {
    let (_folder, path) = made_of(
        r#"<robot name="r"><link name="floor"/><link name="base"/><link name="body"/>
        <joint name="drive" type="planar"><parent link="floor"/><child link="base"/><axis xyz="0 0 1"/></joint>
        <joint name="ball" type="floating"><parent link="base"/><child link="body"/></joint></robot>"#,
    );
    let robot = Robot::open(path).unwrap();
    let base = robot.link("base").unwrap();
    let body = robot.link("body").unwrap();
    assert_eq!(robot.configurations().unwrap().dof_is_limited(), [false; 9]);
    let mut q = vec![5.0, -7.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 3.0];
    for k in 0..100 {
        q[0] += 0.01;
        let turned = f64::from(k).mul_add(0.02, 3.0);
        let (mut wanted, was) = (q.clone(), q.clone());
        (wanted[2], wanted[8]) = (turned, turned);
        let poses = robot.link_poses(&wanted).unwrap();
        q = ask(&robot, Target::pose(base, poses[base]), &q).reached().unwrap().configuration;
        assert!((q[0] - wanted[0]).abs() < 1e-5 && (q[2] - turned).abs() < 1e-5, "{q:?}");
        // With the base locked, the rotation vector alone turns: beyond half a turn.
        let settings = InverseSettings { locked: vec![0, 1, 2], ..InverseSettings::default() };
        let found = robot.inverse_kinematics(&Target::pose(body, poses[body]), &q, &settings);
        q = found.unwrap().reached().expect("reached").configuration;
        assert!((q[8] - turned).abs() < 1e-5, "{q:?} {was:?}");
    }
    // Components of a rotation vector can be locked.
    let settings = InverseSettings { locked: (0..9).collect(), ..InverseSettings::default() };
    let found = robot.inverse_kinematics(&Target::position(body, [0.0; 3]), &q, &settings);
    assert_eq!(found.unwrap().nearest().configuration, q);
}

/// Within bounds of two turns either way, the value is the one nearest to the start, or to the posture.
#[test]
fn of_values_a_turn_apart_the_nearest_counts() {
    let (_folder, path) = made_of(
        r#"<robot name="r"><link name="base"/><link name="arm"/><joint name="turn" type="revolute">
        <parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
        <limit lower="-6.2" upper="8" effort="1" velocity="1"/></joint></robot>"#,
    );
    let robot = Robot::open(path).unwrap();
    let target = Target::rotation(1, UnitQuaternion::from_euler_angles(0.0, 0.0, 3.5));
    let low = 3.5 - std::f64::consts::TAU;
    for (start, posture, expected) in [
        (0.1, None, low),
        (1.0, None, 3.5),
        (-6.0, None, low),
        (7.9, None, 3.5),
        (0.1, Some(6.0), 3.5),
        (6.0, Some(0.1), low),
        (6.0, Some(-30.0), low),
        (0.1, Some(30.0), 3.5),
    ] {
        let posture = posture.map(|at| vec![at]);
        let settings = InverseSettings { posture, ..InverseSettings::default() };
        let found = robot.inverse_kinematics(&target, &[start], &settings).unwrap();
        let q = found.reached().expect("reached").configuration;
        assert!((q[0] - expected).abs() < 1e-5, "{start} {settings:?} {q:?}");
    }
}

/// Why a target is not reached, where geometry says it: the tip is at 0.2 m to 0.8 m from the base without bounds, and from
/// 0.3157 m on with an elbow of at most 2.5 rad.
#[test]
fn verdicts_are_those_of_geometry() {
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    let tip = robot.link("tip").unwrap();
    let at = |x: f64, y: f64, z: f64| Target::position(tip, [x, y, z]);
    let turned = |axis: Vector3<f64>| Target::rotation(tip, UnitQuaternion::from_scaled_axis(axis));
    for (target, expected) in [
        (at(0.0, 0.79, 0.0), Verdict::Reached),
        (at(0.0, 0.81, 0.0), Verdict::OutOfReach),
        (at(-0.32, 0.0, 0.0), Verdict::Reached),
        (at(0.0, 0.31, 0.0), Verdict::Limits),
        (at(0.15, 0.15, 0.0), Verdict::Limits),
        (at(0.1, 0.1, 0.0), Verdict::OutOfReach),
        (at(0.5, 0.0, 0.01), Verdict::OutOfReach),
        // The tip turns about z alone.
        (turned(Vector3::new(0.0, 0.0, 1.0)), Verdict::Reached),
        (turned(Vector3::new(0.5, 0.0, 0.0)), Verdict::OutOfReach),
    ] {
        let found = ask(&robot, target, &[0.3, 0.2, 0.0]);
        assert_eq!(found.nearest().verdict, expected, "{target:?}");
        assert_eq!(found.is_reached(), expected == Verdict::Reached);
        let quick = InverseSettings { explain: false, ..InverseSettings::default() };
        let quick = robot.inverse_kinematics(&target, &[0.3, 0.2, 0.0], &quick);
        let quick = quick.unwrap().nearest().verdict;
        assert!(matches!(quick, Verdict::Reached | Verdict::Unknown), "{quick:?}");
    }
}

#[test]
fn a_rotation_alone_leaves_the_position_free() {
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    let tip = robot.link("tip").unwrap();
    let turn = UnitQuaternion::from_euler_angles(0.0, 0.0, 2.1);
    let found = ask(&robot, Target::rotation(tip, turn), &[0.0, 0.5, 0.0]);
    let q = found.reached().expect("reached").configuration;
    assert!((q[0] + q[1] - 2.1).abs() < 1e-6, "{q:?}");
}

#[test]
fn weights_leave_directions_free() {
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    let tip = robot.link("tip").unwrap();
    // The elbow that the bounds leave reaches this point turned by 1.91 rad.
    let turn = UnitQuaternion::from_euler_angles(0.0, 0.0, 2.0);
    let pose = Isometry3::from_parts(Translation3::new(0.4, 0.3, 0.0), turn);
    let whole = Target::pose(tip, pose);
    let start = [0.0, 0.5, 0.0];
    assert!(!ask(&robot, whole, &start).is_reached());
    let found = ask(&robot, whole.weighted([1.0, 1.0, 1.0, 1.0, 1.0, 0.0]), &start);
    let q = found.reached().expect("reached").configuration;
    let there = robot.link_poses(&q).unwrap()[tip].translation.vector;
    assert!((there - pose.translation.vector).norm() < 1e-6, "{there}");
    // Along the target's own y axis the position is free: the tip is on the line through the point along its x axis.
    let on_line = whole.weighted([0.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
    let q = ask(&robot, on_line, &start).reached().expect("reached").configuration;
    let there = robot.link_poses(&q).unwrap()[tip];
    let off = pose.inverse() * Point3::from(there.translation.vector);
    assert!(off.y.abs() < 1e-6 && off.x.abs() > 0.01, "{off}");
    assert!(there.rotation.angle_to(&turn) < 1e-6);
    let wrong =
        robot.inverse_kinematics(&whole.weighted([-1.0; 6]), &start, &InverseSettings::default());
    assert!(matches!(wrong, Err(RobotError::Target(_))), "{wrong:?}");
}

#[test]
fn locked_dofs_keep_their_values() {
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    let tip = robot.link("tip").unwrap();
    let there = robot.link_poses(&[0.3, 1.1, 0.0]).unwrap()[tip];
    let target = Target::position(tip, there.translation.vector.into());
    let settings = InverseSettings { locked: vec![0], ..InverseSettings::default() };
    let ask = |shoulder: f64| {
        let found = robot.inverse_kinematics(&target, &[shoulder, 0.2, 0.0], &settings);
        found.unwrap()
    };
    let found = ask(0.3).reached().expect("reached").configuration;
    assert!(found[0] == 0.3 && (found[1] - 1.1).abs() < 1e-5, "{found:?}");
    let off = ask(0.5);
    assert!(!off.is_reached() && off.nearest().configuration[0] == 0.5);
    let none = InverseSettings { locked: vec![3], ..InverseSettings::default() };
    let none = robot.inverse_kinematics(&target, &[0.0; 3], &none);
    assert!(matches!(none, Err(RobotError::OutOfRange { index: 3, .. })));
}

/// Three links of 0.4 m, 0.3 m and 0.2 m in a plane: one DOF more than a position needs.
fn redundant() -> String {
    let joint = |k: usize, x: f64| {
        format!(
            r#"<link name="l{k}"/><joint name="j{k}" type="revolute"><parent link="{}"/><child link="l{k}"/>
            <origin xyz="{x} 0 0"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>"#,
            if k == 0 { "base".to_owned() } else { format!("l{}", k - 1) },
        )
    };
    let joints: String =
        [0.0, 0.4, 0.3].into_iter().enumerate().map(|(k, x)| joint(k, x)).collect();
    format!(r#"<robot name="r"><link name="base"/>{joints}</robot>"#)
}

/// Beside every solution: two elbows for each angle of the last link, in steps of a thousandth of a radian.
#[test]
fn the_solution_nearest_to_a_posture() {
    let (_folder, path) = made_of(&redundant());
    let robot = Robot::open(path).unwrap();
    let last = robot.link("l2").unwrap();
    let all = |x: f64, y: f64| {
        (-3141..3142).flat_map(move |k| {
            let angle = f64::from(k) / 1000.0;
            let (wx, wy) = (x - 0.2 * angle.cos(), y - 0.2 * angle.sin());
            let cos = (wx * wx + wy * wy - 0.25) / 0.24;
            let elbow = if cos.abs() > 1.0 { f64::NAN } else { cos.acos() };
            [elbow, -elbow].map(|elbow| {
                let shoulder = wy.atan2(wx) - (0.3 * elbow.sin()).atan2(0.4 + 0.3 * elbow.cos());
                let whole = |x: f64| {
                    (x + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
                        - std::f64::consts::PI
                };
                [whole(shoulder), elbow, whole(angle - shoulder - elbow)]
            })
        })
    };
    let distance =
        |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    for ([x, y], posture) in [
        ([0.5, 0.3], [0.0, 0.0, 0.0]),
        ([0.5, 0.3], [0.5, -1.0, 2.0]),
        ([-0.3, 0.4], [2.0, 1.0, -1.0]),
        ([0.1, -0.6], [-2.5, 1.0, 0.3]),
    ] {
        let settings =
            InverseSettings { posture: Some(posture.to_vec()), ..InverseSettings::default() };
        let target = Target::position(last, [x, y, 0.0]).of_point([0.2, 0.0, 0.0]);
        let found = robot.inverse_kinematics(&target, &[0.1; 3], &settings).unwrap();
        let found = found.reached().expect("reached");
        // It does not take all 100 restarts.
        assert!(found.restarts < 60, "{found:?}");
        let found = found.configuration;
        let within = all(x, y).filter(|q| q.iter().all(|value| value.abs() <= 3.0));
        let least = within.map(|q| distance(&q, &posture)).fold(f64::INFINITY, f64::min);
        let own = distance(&found, &posture);
        assert!(own < least + 1e-4 && own > least - 2e-3, "{own} {least}");
    }
}

#[test]
fn solutions_that_are_refused() {
    let (_folder, path) = made_of(&redundant());
    let robot = Robot::open(path).unwrap();
    let last = robot.link("l2").unwrap();
    let target = Target::position(last, [0.3, 0.3, 0.0]);
    let ask = |accepts: &dyn Fn(&[f64]) -> bool| {
        let settings = InverseSettings::default();
        let found = robot.inverse_kinematics_where(
            &target,
            &[0.1; 3],
            &settings,
            accepts,
            &Default::default(),
        );
        found.unwrap()
    };
    for sign in [1.0, -1.0] {
        let found = ask(&|q| q[1] * sign > 0.0).reached().expect("reached");
        assert!(found.configuration[1] * sign > 0.0, "{found:?}");
    }
    let refused = ask(&|_| false);
    let refused = refused.nearest();
    assert_eq!(refused.verdict, Verdict::Refused);
    assert!(refused.position_error < 1e-6, "{refused:?}");
}

/// The short slide wants out of its bounds on the way to the posture: it ends at a bound, and the others make up for it.
#[test]
fn what_a_posture_wants_out_of_bounds_ends_at_the_bound() {
    const REACHING: &str = r#"<robot name="reaching">
  <link name="base"/><link name="upper"/><link name="fore"/><link name="boom"/><link name="tip"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0.5 0 0"/>
    <axis xyz="0 0 1"/><limit lower="0" upper="2.5" effort="1" velocity="1"/></joint>
  <joint name="long" type="prismatic"><parent link="fore"/><child link="boom"/><origin xyz="0.2 0 0"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.3" effort="1" velocity="1"/></joint>
  <joint name="short" type="prismatic"><parent link="boom"/><child link="tip"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.04" effort="1" velocity="1"/></joint>
</robot>"#;
    let (_folder, path) = made_of(REACHING);
    let robot = Robot::open(path).unwrap();
    let tip = robot.link("tip").unwrap();
    for posture in [[0.4, 0.9, 0.0, -2.0], [-0.5, 1.2, 0.1, 3.0], [1.0, 0.3, 0.25, 0.5]] {
        let settings =
            InverseSettings { posture: Some(posture.to_vec()), ..InverseSettings::default() };
        for [x, y] in [[0.6, 0.3], [0.4, -0.5], [0.2, 0.6]] {
            let target = Target::position(tip, [x, y, 0.0]);
            let found = robot.inverse_kinematics(&target, &[0.0, 1.0, 0.1, 0.02], &settings);
            let found = found.unwrap().reached().expect("within reach");
            // On a grid of both slides, the law of cosines.
            let away = |q: &[f64]| -> f64 {
                q.iter().zip(&posture).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
            };
            let slides = (0..=3000).flat_map(|k| (0..=4).map(move |j| (k, j)));
            let least = slides.filter_map(|(k, j)| {
                let (long, short) = (1e-4 * f64::from(k), 0.01 * f64::from(j));
                let (reach, fore) = (f64::hypot(x, y), 0.2 + long + short);
                let cosine = (reach * reach - 0.25 - fore * fore) / fore;
                let elbow = (cosine.abs() <= 1.0).then(|| cosine.acos())?;
                let shoulder =
                    f64::atan2(y, x) - f64::atan2(fore * elbow.sin(), 0.5 + fore * elbow.cos());
                let q = [shoulder, elbow, long, short];
                (elbow <= 2.5 && shoulder.abs() <= 3.0).then(|| away(&q))
            });
            let least = least.fold(f64::INFINITY, f64::min);
            let own = away(&found.configuration);
            assert!(own <= least * (1.0 + 1e-4), "{posture:?}, {x}, {y}: {own}, {least}");
            let descents = found.restarts + 2;
            assert!(found.iterations <= 25 * descents, "{} of {descents}", found.iterations);
        }
    }
}
