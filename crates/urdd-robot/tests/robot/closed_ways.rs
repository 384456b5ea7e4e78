//! Inverse kinematics and motions on closed configurations: held to closed forms and dense samples.

use urdd_robot::{
    CloseSettings, EdgeSettings, Gap, Inverse, InverseSettings, Obstacle, Obstruction, Queries,
    Robot, RobotError, ShapeKind, Target, Verdict, World,
};

use super::loops::{ROCKERS, robot_of};
use testkit::looped::{FOUR_BAR, four_bar, four_bar_at, leg, made_with_loops};

/// The closed configuration of the leg near another one in which its rods have these lengths.
fn at_lengths(robot: &Robot, near: &[f64], lengths: [f64; 6]) -> Vec<f64> {
    let rods: Vec<usize> = (0..6).map(|k| robot.dof(&format!("rod_{k}")).unwrap()).collect();
    let mut q = near.to_vec();
    rods.iter().zip(lengths).for_each(|(rod, length)| q[*rod] = length);
    let settings = CloseSettings { held: &rods, ..Default::default() };
    robot.close(&q, &settings).unwrap().closed().expect("closed")
}

#[test]
fn inverse_kinematics_stays_closed() {
    let (_folder, robot) = robot_of(&leg());
    let start = robot.loops().unwrap().expect("loops").reference_configuration.clone();
    let start = at_lengths(&robot, &start, [0.5; 6]);
    let foot = robot.link("foot").unwrap();
    let known = robot.configurations().unwrap();
    let before = robot.link_poses(&start).unwrap()[foot];
    for (k, shift) in
        [[0.05, 0.0, 0.02], [-0.03, 0.06, -0.01], [0.0, -0.04, 0.05]].iter().enumerate()
    {
        let turn = nalgebra::UnitQuaternion::from_euler_angles(0.1, -0.05 * k as f64, 0.1);
        let mut pose = before;
        pose.translation.vector += nalgebra::Vector3::from(*shift);
        pose.rotation = turn * before.rotation;
        let target = Target::pose(foot, pose);
        let ask = |settings: &InverseSettings| {
            robot.inverse_kinematics(&target, &start, settings).expect("an answer")
        };
        let found = ask(&InverseSettings::default()).reached().expect("within reach");
        assert!(found.restarts == 0 && found.iterations < 12, "{found:?}");
        let q = &found.configuration;
        assert!(robot.loop_errors(q).unwrap().is_closed && known.is_within_bounds(q));
        let there = robot.link_poses(q).unwrap()[foot];
        assert!((there.translation.vector - pose.translation.vector).norm() < 1e-6);
        assert!(there.rotation.angle_to(&pose.rotation) < 1e-6);
        // The tree has one rod that reaches alone.
        let open = ask(&InverseSettings { open_loops: true, ..Default::default() });
        let open = open.reached().expect("within reach").configuration;
        assert!(!robot.loop_errors(&open).unwrap().is_closed);
        // A rod that is locked leaves five freedoms: the foot's height follows.
        let rod = robot.dof("rod_3").unwrap();
        let settings = InverseSettings {
            locked: vec![rod],
            posture: Some(start.clone()),
            ..Default::default()
        };
        let free = target.weighted([1.0, 1.0, 0.0, 1.0, 1.0, 1.0]);
        let found = robot.inverse_kinematics(&free, &start, &settings).unwrap();
        let q = found.reached().expect("within reach").configuration;
        assert!(q[rod] == start[rod] && robot.loop_errors(&q).unwrap().is_closed);
    }
    // 0.9 m are more than a rod has.
    let mut far = before;
    far.translation.z = 0.9 * before.translation.z.signum();
    let ask = |pose| {
        let settings = InverseSettings { restarts: 5, ..Default::default() };
        robot.inverse_kinematics(&Target::pose(foot, pose), &start, &settings).unwrap()
    };
    let found = ask(far);
    assert_eq!(found.nearest().verdict, Verdict::Limits);
    assert!(robot.loop_errors(&found.nearest().configuration).unwrap().is_closed);
}

#[test]
fn what_only_the_tree_reaches_has_a_verdict() {
    let (_folder, robot) = robot_of(&four_bar(FOUR_BAR, ""));
    let rocker = robot.link("rocker_link").unwrap();
    let start = four_bar_at(FOUR_BAR, 0.5, -1.0);
    let ask = |angle: f64, settings: &InverseSettings| {
        let turn = nalgebra::UnitQuaternion::from_euler_angles(0.0, 0.0, angle);
        robot.inverse_kinematics(&Target::rotation(rocker, turn), &start, settings).unwrap()
    };
    let settings = InverseSettings::default();
    // Where the rocker is at other angles of the crank.
    for crank in [0.1, 1.0, 2.0, 3.0, 4.5] {
        let expected = four_bar_at(FOUR_BAR, crank, -1.0);
        let found = ask(expected[2], &settings).reached().expect("within reach").configuration;
        let again = four_bar_at(FOUR_BAR, found[0], -1.0);
        assert!((again[2] - expected[2]).sin().abs() < 1e-5, "{found:?}, {expected:?}");
    }
    // A rocker never points at the ground's other hinge beyond where crank and coupler are in a line.
    let found = ask(0.0, &settings);
    assert_eq!(found.nearest().verdict, Verdict::Loops);
    let q = &found.nearest().configuration;
    assert!(robot.loop_errors(q).unwrap().is_closed && found.nearest().rotation_error > 0.1);
    let unknown = ask(0.0, &InverseSettings { explain: false, ..Default::default() });
    assert_eq!(unknown.nearest().verdict, Verdict::Unknown);
    assert!(ask(0.0, &InverseSettings { open_loops: true, ..Default::default() }).is_reached());
    // Locked where nothing closes.
    let (_folder, robot) = robot_of(&four_bar(ROCKERS, ""));
    let locked = InverseSettings { locked: vec![0], restarts: 3, ..Default::default() };
    let start = [std::f64::consts::PI, 0.0, 3.0];
    let target = Target::rotation(rocker, nalgebra::UnitQuaternion::identity());
    let found = robot.inverse_kinematics(&target, &start, &locked).unwrap();
    let Inverse::Nearest(nearest) = found else { panic!("{found:?}") };
    assert_eq!((nearest.verdict, nearest.configuration[0]), (Verdict::Loops, start[0]));
    assert!(!robot.loop_errors(&nearest.configuration).unwrap().is_closed);
}

#[test]
fn motions_follow_the_closed_configurations() {
    let (_folder, robot) = robot_of(&four_bar(FOUR_BAR, ""));
    let proximity = robot.proximity(ShapeKind::Hulls).unwrap();
    let fine = EdgeSettings { resolution: Some(0.002), ..Default::default() };
    let (from, to) = (0.3, 2.5);
    let at = |part: f64| four_bar_at(FOUR_BAR, from + part * (to - from), -1.0);
    let [start, end] = [0.0, 1.0].map(at);
    assert_eq!(proximity.blocked_edge(&start, &end, &fine), Ok(None));
    // A post in the way of the rocker's end, where it is at seven tenths of the motion.
    let rocker = at(0.7)[2];
    let post = nalgebra::Isometry3::translation(
        FOUR_BAR[0] + FOUR_BAR[3] * rocker.cos(),
        FOUR_BAR[3] * rocker.sin(),
        0.1,
    );
    let post = Obstacle::sphere("post", post.translation.vector.into(), 0.005).expect("a post");
    let world = proximity.world_proximity(&World::new([post])).unwrap();
    let first = (0..=20_000).map(|k| f64::from(k) / 20_000.0);
    let first = first.clone().find(|part| world.in_collision(&at(*part)).unwrap()).expect("one");
    let found = world.first_contact(&start, &end, &fine).unwrap().expect("blocked");
    assert_eq!(found.obstruction, Obstruction::Contact);
    assert!(found.free <= first && first - 1e-4 <= found.blocked, "{found:?}, {first}");
    assert!(found.blocked - found.free < 1e-5, "{found:?}");
    let any = world.blocked_edge(&start, &end, &fine).unwrap().expect("blocked");
    assert!(world.in_collision(&at(any)).unwrap(), "{any}");
    // The way back is the same.
    let back = world.first_contact(&end, &start, &fine).unwrap().expect("blocked");
    assert!(world.in_collision(&at(1.0 - back.blocked)).unwrap(), "{back:?}");
    assert!(!world.in_collision(&at(1.0 - back.free)).unwrap(), "{back:?}");
    // A whole turn ends where it began.
    let turn = [start[0] + std::f64::consts::TAU, start[1], start[2]];
    assert_eq!(proximity.first_contact(&start, &turn, &fine), Ok(None));
    // The straight motion of the tree is another one, and can be proved.
    let open = EdgeSettings { open_loops: true, ..fine };
    let straight = world.first_contact(&start, &end, &open).unwrap();
    assert!(straight.is_none_or(|one| (one.blocked - first).abs() > 1e-3), "{straight:?}");
    let proved = EdgeSettings { resolution: None, open_loops: true, ..fine };
    assert_eq!(proximity.blocked_edge(&start, &end, &proved), Ok(None));
    let proved = EdgeSettings { resolution: None, ..fine };
    let refused = proximity.blocked_edge(&start, &end, &proved);
    assert!(matches!(refused, Err(RobotError::Setting(_))), "{refused:?}");
    // The other branch has the same crank.
    let other = four_bar_at(FOUR_BAR, to, 1.0);
    let found = proximity.first_contact(&start, &other, &fine).unwrap().expect("blocked");
    assert_eq!((found.blocked, found.obstruction), (1.0, Obstruction::Branch));
    assert_eq!(proximity.blocked_edge(&start, &other, &fine), Ok(Some(1.0)));
    // An end that is open is an error with its gap.
    let mut open = end;
    open[1] += 0.01;
    let gap = Gap { position: 2.0 * FOUR_BAR[2] * 0.005_f64.sin(), rotation: 0.0 };
    match proximity.blocked_edge(&start, &open, &fine) {
        Err(RobotError::NotClosed { end: "end", name, gap: found }) => {
            assert!(name == "pin" && (found.position - gap.position).abs() < 1e-12);
        }
        other => panic!("{other:?}"),
    }
    assert!(proximity.first_contact(&open, &end, &fine).unwrap_err().to_string().contains("start"));
}

#[test]
fn a_motion_ends_where_nothing_closes() {
    let (_folder, robot) = robot_of(&four_bar(ROCKERS, ""));
    let proximity = robot.proximity(ShapeKind::Hulls).unwrap();
    let fine = EdgeSettings { resolution: Some(0.002), ..Default::default() };
    let to = std::f64::consts::TAU - 0.5;
    let [start, end] = [0.5, to].map(|crank| four_bar_at(ROCKERS, crank, 1.0));
    let found = proximity.first_contact(&start, &end, &fine).unwrap().expect("blocked");
    // The crank's end is 0.45 m from the rocker's hinge.
    let dead = ((0.45_f64.powi(2) - 0.25) / (-2.0 * 0.4 * 0.3)).acos();
    let dead = (dead - 0.5) / (to - 0.5);
    assert_eq!(found.obstruction, Obstruction::Open);
    assert!(found.free <= dead && dead <= found.blocked, "{found:?}, {dead}");
    assert!(found.blocked - found.free < 1e-5, "{found:?}");
    let any = proximity.blocked_edge(&start, &end, &fine).unwrap();
    assert_eq!(any, Some(found.blocked));
}

#[test]
fn a_coupling_that_does_not_hold_is_named() {
    let urdf = r#"<robot name="gears"><link name="base"/><link name="a_link"/><link name="b_link"/>
        <joint name="a" type="continuous"><parent link="base"/><child link="a_link"/><axis xyz="0 0 1"/></joint>
        <joint name="b" type="continuous"><parent link="base"/><child link="b_link"/><axis xyz="0 0 1"/></joint></robot>"#;
    let toml = "independent = [\"a\"]\n[[coupling]]\nname = \"gear\"\nconstant = 0.25\nterms = { a = [2.0], b = [-1.0] }\n";
    let (_folder, path) = made_with_loops(urdf, toml);
    let robot = Robot::open(path).expect("a robot");
    let q = robot.close(&[0.5, 0.0], &CloseSettings { held: &[0], bounds: None }).unwrap();
    let q = q.closed().expect("closed");
    assert!((q[1] - 1.25).abs() < 1e-12, "{q:?}");
    assert_eq!(robot.loop_velocities(&q, &[3.0]), Ok(Some(vec![3.0, 6.0])));
    let proximity = robot.proximity(ShapeKind::Hulls).unwrap();
    let open = [0.5, 0.0];
    let expected = RobotError::NotCoupled { end: "start", name: "gear".to_owned(), sum: 1.25 };
    assert_eq!(proximity.blocked_edge(&open, &q, &EdgeSettings::default()), Err(expected));
    let far = [10.5, 21.25];
    assert_eq!(proximity.blocked_edge(&q, &far, &EdgeSettings::default()), Ok(None));
}

/// Gears beside the four-bar, which no loop ties to it.
const GEARS: &str = r#"<link name="a_link"/><link name="b_link"/>
<joint name="a" type="continuous"><parent link="ground"/><child link="a_link"/><axis xyz="0 0 1"/></joint>
<joint name="b" type="continuous"><parent link="ground"/><child link="b_link"/><axis xyz="0 0 1"/></joint>
<coupling name="gear"><predecessor link="a_link"/><successor link="b_link"/><ratio value="2"/></coupling>"#;

#[test]
fn a_solution_closes_what_does_not_move_the_link_too() {
    let (_folder, robot) = robot_of(&four_bar(FOUR_BAR, GEARS));
    let (a, b) = (robot.dof("a").unwrap(), robot.dof("b").unwrap());
    let mut start = robot.reference_configuration().unwrap();
    start[..3].copy_from_slice(&four_bar_at(FOUR_BAR, 0.5, -1.0));
    (start[a], start[b]) = (0.3, 0.1);
    assert!(!robot.loop_errors(&start).unwrap().is_closed);
    let rocker = robot.link("rocker_link").unwrap();
    let turn = four_bar_at(FOUR_BAR, 1.0, -1.0)[2];
    let turn = nalgebra::UnitQuaternion::from_euler_angles(0.0, 0.0, turn);
    let target = Target::rotation(rocker, turn);
    let settings = InverseSettings { locked: vec![a], ..Default::default() };
    let found = robot.inverse_kinematics(&target, &start, &settings).unwrap();
    let q = found.reached().expect("within reach").configuration;
    assert!(robot.loop_errors(&q).unwrap().is_closed && q[a] == 0.3, "{q:?}");
    assert!((q[b] - 0.6).abs() < 1e-9, "{q:?}");
    // Which cannot close with both of them locked.
    let settings = InverseSettings { locked: vec![a, b], restarts: 1, ..Default::default() };
    let found = robot.inverse_kinematics(&target, &start, &settings).unwrap();
    assert_eq!(found.nearest().verdict, Verdict::Loops);
}
