//! What planners ask beside distances: margins, gradients, motions between configurations. Beside closed forms, central
//! differences and dense samples.

use std::path::Path;

use nalgebra::{Isometry3, Point3};
use urdd_kinematics::ForwardKinematics;
use urdd_robot::{
    EdgeSettings, FirstContact, Obstacle, Obstruction, Queries, Robot, RobotError, ShapeKind, World,
};

use testkit::robots::{made, made_of, our_robots};

#[path = "../../../../examples/rrt_connect.rs"]
#[allow(dead_code)]
mod rrt_connect;

pub(super) fn robot_of(name: &str) -> (tempfile::TempDir, Robot) {
    let robots = our_robots();
    let (_, urdf) = robots.iter().find(|(found, _)| found == name).expect(name);
    let (folder, path) = made(urdf);
    (folder, Robot::open(path).expect("a robot"))
}

/// A box of 0.2 m that slides along x from a base beside it.
pub(super) const SLIDE: &str = r#"<robot name="r"><link name="base"><visual><origin xyz="-1 0 0"/><geometry><box size="0.2 0.2 0.2"/></geometry></visual></link>
<link name="box"><visual><geometry><box size="0.2 0.2 0.2"/></geometry></visual></link>
<joint name="x" type="prismatic"><parent link="base"/><child link="box"/><axis xyz="1 0 0"/><limit lower="-2" upper="4" effort="1" velocity="1"/></joint></robot>"#;

/// With `x` at 0 the boxes are 0.8 m apart.
#[test]
fn a_sliding_box_has_closed_forms() {
    let (_folder, path) = made_of(SLIDE);
    let robot = Robot::open(path).expect("a robot");
    let proximity = robot.proximity_of(ShapeKind::Hulls, |_| true).expect("shapes");
    let within = |x: f64, margin: f64| proximity.is_within(&[x], margin).expect("an answer");
    assert!(!within(0.0, 0.799) && within(0.0, 0.801));
    assert!(within(-0.9, 0.0) && !within(-0.7, 0.0));
    let found = proximity.gradients(&[0.5], 3).expect("gradients");
    assert_eq!(found.len(), 1);
    assert!((found[0].pair.distance - 1.3).abs() < 1e-6);
    let gradient = found[0].gradient.as_ref().expect("apart");
    assert!((gradient[0] - 1.0).abs() < 1e-12, "{gradient:?}");
    assert_eq!(proximity.gradients(&[-0.9], 1).expect("gradients")[0].gradient, None);

    // From x = 1 to x = -1: they are 0.3 m apart at x = -0.5, after 3/4 of the motion.
    let edge = |resolution: Option<f64>, margin: f64| {
        let settings = EdgeSettings { margin, resolution, ..Default::default() };
        proximity.blocked_edge(&[1.0], &[-1.0], &settings).expect("an answer")
    };
    let proved = edge(None, 0.3).expect("blocked");
    assert!((proved - 0.75).abs() < 1e-4 && proved <= 0.75, "{proved}");
    assert_eq!(edge(Some(0.01), 0.3), Some(1.0));
    let away = EdgeSettings { margin: 0.3, resolution: None, ..Default::default() };
    assert_eq!(proximity.blocked_edge(&[1.0], &[3.0], &away), Ok(None));
    assert_eq!(proximity.blocked_edge(&[1.0], &[1.0], &away), Ok(None));

    // An obstacle from x = 2 to 2.2 is 0.9 m from the box at x = 1.
    let wall = Obstacle::cuboid("wall", Isometry3::translation(2.1, 0.0, 0.0), [0.1, 1.0, 1.0])
        .expect("a wall");
    let proximity = robot.proximity(ShapeKind::Hulls).expect("shapes");
    let world = proximity.world_proximity(&World::new([wall.ignoring("base")])).expect("a world");
    assert!(!world.is_within(&[1.0], 0.89).expect("an answer"));
    assert!(world.is_within(&[1.0], 0.91).expect("an answer"));
    let settings = EdgeSettings { margin: 0.0, resolution: None, ..Default::default() };
    let at = world.blocked_edge(&[0.0], &[4.0], &settings).expect("an answer").expect("blocked");
    assert!((at - 1.9 / 4.0).abs() < 1e-4 && at <= 1.9 / 4.0, "{at}");
    // Sampled, the wall is between two configurations that are too far apart, and the halves come first.
    let coarse = EdgeSettings { margin: 0.0, resolution: Some(10.0), ..Default::default() };
    assert_eq!(world.blocked_edge(&[0.0], &[4.0], &coarse), Ok(None));
    let fine = EdgeSettings { margin: 0.0, resolution: Some(0.1), ..Default::default() };
    assert_eq!(world.blocked_edge(&[0.0], &[4.0], &fine), Ok(Some(0.5)));
    let first = world.first_contact(&[0.0], &[4.0], &fine).expect("an answer").expect("blocked");
    assert!(first.free <= 1.9 / 4.0 && 1.9 / 4.0 <= first.blocked, "{first:?}");
    assert!((first.blocked - first.free) * 4.0 <= 0.1 / 1000.0, "{first:?}");
    let first = world.first_contact(&[0.0], &[4.0], &settings);
    let first = first.expect("an answer").expect("blocked");
    assert!(first.free <= at && first.blocked == at && at - first.free < 1e-3, "{first:?}");
    // From within the wall, toward it, and away from it.
    for settings in [settings, fine] {
        let first = |start: f64, end: f64| world.first_contact(&[start], &[end], &settings);
        assert_eq!(
            first(2.0, 0.0),
            Ok(Some(FirstContact { free: 0.0, blocked: 0.0, obstruction: Obstruction::Contact }))
        );
        assert_eq!(first(1.0, -1.0), Ok(None));
    }
}

/// Beside configurations in order, ten times as dense. A contact that they find and `first_contact` does not is shorter
/// than the resolution.
#[test]
fn the_first_contact_is_that_of_dense_samples() {
    let (_folder, robot) = robot_of("six_axis_arm");
    let proximity = robot.proximity(ShapeKind::Pieces).expect("shapes");
    let balls = [[0.5, 0.2, 0.4], [-0.3, 0.4, 0.6], [0.1, -0.5, 0.3]];
    let world =
        World::new(balls.map(|centre| Obstacle::sphere("ball", centre, 0.1).expect("a sphere")));
    let world = proximity.world_proximity(&world).expect("a world");
    let space = robot.configurations().expect("bounds");
    let (settings, mut found, mut late) = (EdgeSettings::default(), 0, 0);
    for k in 0..40 {
        let (start, end) = (space.random(2 * k), space.random(2 * k + 1));
        let at = |part: f64| -> Vec<f64> {
            start.iter().zip(&end).map(|(from, to)| from + part * (to - from)).collect()
        };
        let touches = |part: f64| world.in_collision(&at(part)).expect("an answer");
        if touches(0.0) {
            continue;
        }
        let any = world.blocked_edge(&start, &end, &settings).expect("an answer");
        let first = world.first_contact(&start, &end, &settings).expect("an answer");
        assert_eq!(any.is_some(), first.is_some(), "{k}");
        let Some(first) = first else { continue };
        assert!(!touches(first.free) && touches(first.blocked), "{k} {first:?}");
        assert!(any.is_some_and(|any| any >= first.free), "{k}");
        late += usize::from(any > Some(first.blocked + 0.02));
        // No point travels farther than the sum of all turns times 2 m.
        let turns: f64 = start.iter().zip(&end).map(|(from, to)| (to - from).abs()).sum();
        let dense = (200.0 * turns / 0.01).ceil();
        let before = (0..).map(|step| f64::from(step) / dense);
        let before: Vec<f64> = before.take_while(|part| *part < first.free).collect();
        let longest = before.split(|part| !touches(*part)).map(<[f64]>::len).max();
        let step = 0.01 / (turns * 0.05);
        assert!(longest.unwrap_or_default() as f64 / dense <= step, "{k} {longest:?} {dense}");
        found += 1;
    }
    assert!(found >= 10 && late >= 5, "{found} {late}");
}

#[test]
fn margins_are_those_of_distances() {
    let (_folder, robot) = robot_of("six_axis_arm");
    let proximity = robot.proximity(ShapeKind::Pieces).expect("shapes");
    let space = robot.configurations().expect("bounds");
    let mut both = [0, 0];
    for k in 0..200 {
        let q = space.random(k);
        let least = proximity.self_distance(&q).expect("a distance").expect("pairs");
        for margin in [0.0, 0.01, 0.05, 0.2] {
            let expected = least <= margin;
            assert_eq!(proximity.is_within(&q, margin), Ok(expected), "{k} {margin}");
            both[usize::from(expected)] += 1;
        }
    }
    assert!(both.iter().all(|count| *count > 50), "{both:?}");
}

#[test]
fn gradients_are_central_differences() {
    let mut compared = 0;
    for name in ["six_axis_arm", "hand", "quadruped", "planar_base_arm"] {
        let (_folder, robot) = robot_of(name);
        let proximity = robot.proximity(ShapeKind::Hulls).expect("shapes");
        let space = robot.configurations().expect("bounds");
        for k in 0..10 {
            let q = space.random(k);
            let place = |pair: &urdd_robot::PairDistance| {
                let wanted = [0, 1].map(|of| (pair.link_idxs[of], pair.pieces[of]));
                proximity.pairs().position(|pair| pair == wanted).expect("a pair")
            };
            for found in proximity.gradients(&q, 4).expect("gradients") {
                let Some(gradient) = &found.gradient else {
                    assert_eq!(found.pair.distance, 0.0);
                    continue;
                };
                let pair = place(&found.pair);
                let distance = |dof: usize, by: f64| {
                    let mut q = q.clone();
                    q[dof] += by;
                    proximity.distances(&q).expect("distances")[pair]
                };
                for (dof, expected) in gradient.iter().enumerate() {
                    let sides =
                        [-1e-5, 1e-5].map(|by| (distance(dof, by) - found.pair.distance) / by);
                    // Where the closest points jump, the distance has two derivatives, and this is one of them.
                    let (least, most) = (sides[0].min(sides[1]), sides[0].max(sides[1]));
                    assert!(
                        *expected > least - 1e-3 && *expected < most + 1e-3,
                        "{name} {k} {dof}: {expected} is not in {sides:?}"
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 500, "{compared}");
}

/// Of all types of joints: no point travels farther than the bound, and a single joint's bound is its arc.
#[test]
fn no_point_travels_farther_than_the_bound() {
    for name in ["toy_all_joints", "hand", "six_axis_arm"] {
        let robots = our_robots();
        let (_, urdf) = robots.iter().find(|(found, _)| found == name).expect(name);
        let (_folder, path) = made(urdf);
        let robot = Robot::open(&path).expect("a robot");
        let space = robot.configurations().expect("bounds");
        let kinematics = kinematics(&path);
        for k in 0..6 {
            let (start, end) = (space.random(2 * k), space.random(2 * k + 1));
            let travel = kinematics.travel(&start, &end).expect("finite");
            let at = |part: f64| -> Vec<f64> {
                start.iter().zip(&end).map(|(from, to)| from + part * (to - from)).collect()
            };
            let root = kinematics.root();
            for link in 0..kinematics.num_links() {
                let points = [[0.1, 0.0, 0.0], [0.0, -0.1, 0.0], [0.05, 0.05, 0.05]];
                let bound = travel.of_points(link, 0.1, root);
                let mut lengths = [0.0; 3];
                let mut before: Option<Vec<Point3<f64>>> = None;
                for step in 0..=200 {
                    let pose =
                        kinematics.link_poses(&at(f64::from(step) / 200.0)).expect("poses")[link];
                    let now: Vec<Point3<f64>> =
                        points.iter().map(|p| pose * Point3::from(*p)).collect();
                    if let Some(before) = &before {
                        for (length, (a, b)) in lengths.iter_mut().zip(before.iter().zip(&now)) {
                            *length += (b - a).norm();
                        }
                    }
                    before = Some(now);
                }
                for length in lengths {
                    assert!(
                        length <= bound * (1.0 + 1e-9) + 1e-12,
                        "{name} link {link}: {length} {bound}"
                    );
                }
            }
        }
    }
}

fn kinematics(path: &Path) -> ForwardKinematics {
    let module = |name: &str| std::fs::read(path.join(name).join("module.json")).expect("a module");
    let chain = serde_json::from_slice(&module("chain_module")).expect("a chain");
    let dof = serde_json::from_slice(&module("dof_module")).expect("DOFs");
    ForwardKinematics::new(&chain, &dof).expect("kinematics")
}

/// A motion that is proved free is free wherever it is sampled; one that is not has less than the slack where it says so.
#[test]
fn proofs_hold_at_every_sample() {
    let (_folder, robot) = robot_of("six_axis_arm");
    let proximity = robot.proximity(ShapeKind::Pieces).expect("shapes");
    let space = robot.configurations().expect("bounds");
    let proof = EdgeSettings { margin: 0.02, resolution: None, ..Default::default() };
    let dense = EdgeSettings { margin: 0.02, resolution: Some(0.002), ..Default::default() };
    let mut counts = [0, 0];
    for k in 0..60 {
        let (start, mut end) = (space.random(2 * k), space.random(2 * k + 1));
        for (to, from) in end.iter_mut().zip(&start) {
            *to = from + 0.2 * (*to - from);
        }
        let proved = proximity.blocked_edge(&start, &end, &proof).expect("an answer");
        let sampled = proximity.blocked_edge(&start, &end, &dense).expect("an answer");
        match proved {
            None => assert_eq!(sampled, None, "{k}"),
            Some(part) => {
                let q: Vec<f64> =
                    start.iter().zip(&end).map(|(from, to)| from + part * (to - from)).collect();
                let least = proximity.self_distance(&q).expect("a distance").expect("pairs");
                assert!(least <= 0.02 + 1.01e-4, "{k}: {least}");
            }
        }
        counts[usize::from(proved.is_none())] += 1;
    }
    assert!(counts.iter().all(|count| *count > 5), "{counts:?}");
}

#[test]
fn settings_that_make_no_sense_are_refused() {
    let (_folder, path) = made_of(SLIDE);
    let robot = Robot::open(path).expect("a robot");
    let proximity = robot.proximity(ShapeKind::Hulls).expect("shapes");
    for margin in [-1e-9, f64::NAN, f64::INFINITY] {
        assert!(matches!(proximity.is_within(&[0.0], margin), Err(RobotError::Setting(_))));
    }
    let edge = |resolution: f64, end: f64| {
        let settings =
            EdgeSettings { margin: 0.0, resolution: Some(resolution), ..Default::default() };
        proximity.blocked_edge(&[0.0], &[end], &settings)
    };
    for resolution in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(edge(resolution, 1.0), Err(RobotError::Setting(_))));
    }
    assert!(matches!(edge(0.01, f64::NAN), Err(RobotError::Configuration(_))));
    assert!(proximity.blocked_edge(&[0.0, 1.0], &[0.0], &EdgeSettings::default()).is_err());
}

/// Of all types of joints: a motion that is too long for its resolution ends with an error, and so does a proof of one.
#[test]
fn motions_without_end_are_refused() {
    for name in ["six_axis_arm", "toy_all_joints", "planar_base_arm"] {
        let (_folder, robot) = robot_of(name);
        let proximity = robot.proximity(ShapeKind::Hulls).expect("shapes");
        let beside = Obstacle::sphere("beside", [5.0, 0.0, 0.0], 0.1).expect("a sphere");
        let world = proximity.world_proximity(&World::new([beside])).expect("a world");
        let start = robot.configurations().expect("bounds").zero();
        let ask = |dof: usize, length: f64, resolution: Option<f64>| {
            let mut end = start.clone();
            end[dof] = length;
            let settings = EdgeSettings { margin: 0.0, resolution, ..Default::default() };
            let all = [
                proximity.blocked_edge(&start, &end, &settings),
                world.first_contact(&start, &end, &settings).map(|one| one.map(|one| one.free)),
            ];
            for found in all {
                match found {
                    // Others than the first joint of the arm, which turns it, may end at a contact, or move nothing.
                    Ok(_) => assert!((name, dof) != ("six_axis_arm", 0), "{length} {found:?}"),
                    Err(RobotError::Steps { .. } | RobotError::Configuration(_)) => {}
                    other => panic!("{name} {dof} {length} {other:?}"),
                }
            }
        };
        for dof in 0..start.len() {
            for length in [1e7, 1e300, f64::MAX, -f64::MAX] {
                ask(dof, length, Some(0.01));
                ask(dof, length, Some(f64::MIN_POSITIVE));
            }
        }
        ask(0, if name == "six_axis_arm" { 1e7 } else { f64::MAX }, None);
    }
}

/// The example finds paths between random configurations, which are free at a tenth of its resolution.
#[test]
fn the_example_plans_fifty_motions_of_fifty() {
    let (_folder, robot) = robot_of("welding_arm");
    let proximity = robot.proximity(ShapeKind::Pieces).expect("shapes");
    let world = rrt_connect::world(&robot).expect("obstacles");
    let world = proximity.world_proximity(&world).expect("a world");
    let checks = (&proximity, &world);
    let space = robot.configurations().expect("bounds");
    let is_free = |a: &[f64], b: &[f64], resolution: f64| {
        rrt_connect::is_free(checks, a, b, Some(resolution)).expect("an answer")
    };
    let mut ends = (0..).map(|k| space.random(k)).filter(|q| is_free(q, q, 1.0));
    for query in 0..50 {
        let [start, goal] = [(); 2].map(|()| ends.next().expect("a free one"));
        let mut samples = (1_000_000 * (query + 1)..).map(|k| space.random(k));
        let sample = || samples.next().expect("another one");
        let path = rrt_connect::plan(checks, &start, &goal, sample).expect("an answer");
        let path = path.unwrap_or_else(|| panic!("{query}: no path"));
        assert_eq!((&path[0], &path[path.len() - 1]), (&start, &goal), "{query}");
        for edge in path.windows(2) {
            assert!(is_free(&edge[0], &edge[1], 0.002), "{query}");
        }
    }
}
