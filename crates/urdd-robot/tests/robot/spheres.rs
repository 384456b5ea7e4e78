//! Spheres in the place of shapes, compared with distances in 64 bits.

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use urdd_robot::spheres::{
    ApproximateAnswer, Coverage, CoveringAnswer, LinkSpheres, Sphere, SphereChecker, SphereLevel,
};
use urdd_robot::{EdgeSettings, Obstacle, Queries, Robot, RobotError, ShapeKind, World};

use super::planning::{SLIDE, robot_of};
use testkit::robots::made_of;

/// Numbers from 0 to 1.
pub(super) struct Numbers(pub u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn within(&mut self, size: f64) -> f64 {
        size * (2.0 * self.next() - 1.0)
    }

    fn vector(&mut self, size: f64) -> [f64; 3] {
        [self.within(size), self.within(size), self.within(size)]
    }

    pub fn pose(&mut self, size: f64) -> Isometry3<f64> {
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(self.vector(2.0)));
        Isometry3::from_parts(Translation3::from(self.vector(size)), rotation)
    }
}

/// Three spheres on each link.
fn level(robot: &Robot, numbers: &mut Numbers, covers: bool) -> SphereLevel {
    let sphere = |numbers: &mut Numbers| Sphere {
        centre: numbers.vector(0.1),
        radius: 0.01 + 0.02 * numbers.next(),
    };
    let links = 0..robot.link_names().expect("links").len();
    let links = links.map(|link_idx| LinkSpheres {
        link_idx,
        spheres: (0..3).map(|_| sphere(numbers)).collect(),
    });
    SphereLevel { links: links.collect(), covers }
}

fn placed(poses: &[Isometry3<f64>], level: &SphereLevel, link: usize) -> Vec<(Point3<f64>, f64)> {
    let own = level.links[link].spheres.iter();
    own.map(|sphere| (poses[link] * Point3::from(sphere.centre), sphere.radius)).collect()
}

/// Some configurations: within the bounds, and far beyond them.
fn configurations(robot: &Robot, numbers: &mut Numbers) -> Vec<Vec<f64>> {
    let space = robot.configurations().expect("configurations");
    let inside = (0..60).map(|k| space.random(k));
    let mut beyond = |size: f64| {
        (0..robot.dof_names().expect("DOFs").len()).map(|_| numbers.within(size)).collect()
    };
    let beyond: Vec<Vec<f64>> = [1e1, 1e2, 1e3, 2e6].iter().map(|size| beyond(*size)).collect();
    inside.chain(beyond).collect()
}

/// With a margin that is the least distance, covering spheres are never free; with a little less, they are.
fn holds<C: Coverage<Answer = CoveringAnswer>>(
    checker: &SphereChecker<C>,
    configuration: &[f64],
    distance: f64,
    size: f64,
) {
    let ask = |margin: f64| checker.is_within(configuration, margin).expect("an answer");
    if distance <= 0.0 {
        assert_eq!(ask(0.0), CoveringAnswer::Maybe, "{configuration:?}: {distance}");
        return;
    }
    assert_eq!(ask(distance), CoveringAnswer::Maybe, "{configuration:?}: {distance}");
    let less = distance - 2e-4 * (1.0 + size);
    if less > 0.0 {
        assert_eq!(ask(less), CoveringAnswer::Free, "{configuration:?}: {distance}");
    }
}

const ROBOTS: [&str; 5] =
    ["toy_all_joints", "planar_base_arm", "quadruped", "six_axis_arm", "hand"];

#[test]
fn covering_spheres_are_free_only_where_they_are_apart() {
    for name in ROBOTS {
        let (_folder, robot) = robot_of(name);
        let mut numbers = Numbers(7);
        let level = level(&robot, &mut numbers, true);
        let at = |q: &[f64]| robot.link_poses(q).expect("poses");
        let space = robot.configurations().expect("configurations");
        let [one, two] = [1, 2].map(|k| at(&space.random(k)));
        let count = level.links.len();
        // A margin counts for links that move against each other.
        let moves = |[a, b]: [usize; 2]| {
            let apart = (one[a].inverse() * one[b]).inverse() * (two[a].inverse() * two[b]);
            apart.translation.vector.norm() + apart.rotation.angle() > 1e-9
        };
        let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b]));
        let pairs: Vec<[usize; 2]> = pairs.filter(|pair| moves(*pair)).collect();
        assert!(!pairs.is_empty(), "{name}");
        for pair in pairs.iter().step_by(pairs.len().div_ceil(12)) {
            let checker = SphereChecker::covering(&robot, std::slice::from_ref(&level), &[*pair]);
            let checker = checker.expect("spheres");
            for q in configurations(&robot, &mut numbers) {
                let poses = at(&q);
                let [a, b] = pair.map(|link| placed(&poses, &level, link));
                let apart = |(p, r): &(Point3<f64>, f64), (q, s): &(Point3<f64>, f64)| {
                    (p - q).norm() - r - s
                };
                let distance = a.iter().flat_map(|a| b.iter().map(move |b| apart(a, b)));
                let distance = distance.fold(f64::INFINITY, f64::min);
                let size: f64 = poses.iter().map(|pose| pose.translation.vector.norm()).sum();
                holds(&checker, &q, distance, size);
            }
        }
    }
}

/// How far a point is from an obstacle, m.
type Apart = Box<dyn Fn(Point3<f64>) -> f64>;

/// Each kind of obstacle.
fn obstacles(numbers: &mut Numbers) -> Vec<(Obstacle, Apart)> {
    let [pose, other, third, fourth, fifth] = [0; 5].map(|_| numbers.pose(0.5));
    let half = [0.1, 0.05, 0.2];
    let box_apart = move |p: Point3<f64>, half: [f64; 3]| {
        Vector3::from([0, 1, 2].map(|k| (p[k].abs() - half[k]).max(0.0))).norm()
    };
    let (radius, length) = (0.08, 0.15);
    let cloud: Vec<[f64; 3]> = (0..700).map(|_| numbers.vector(0.4)).collect();
    let heights: Vec<f64> = (0..35).map(|_| 0.2 * numbers.next()).collect();
    let (points, field) = (cloud.clone(), heights.clone());
    let tetrahedron = [[0.0; 3], [0.3, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 0.3]];
    vec![
        (
            Obstacle::cuboid("box", pose, half).expect("an obstacle"),
            Box::new(move |p| box_apart(pose.inverse() * p, half)),
        ),
        (
            Obstacle::sphere("ball", [0.3, 0.2, 0.1], radius).expect("an obstacle"),
            Box::new(move |p| (p - Point3::new(0.3, 0.2, 0.1)).norm() - radius),
        ),
        (
            Obstacle::capsule("capsule", other, radius, length).expect("an obstacle"),
            Box::new(move |p| {
                let p = other.inverse() * p;
                (p - Point3::new(0.0, 0.0, p.z.clamp(-length, length))).norm() - radius
            }),
        ),
        (
            Obstacle::cylinder("cylinder", third, radius, length).expect("an obstacle"),
            Box::new(move |p| {
                let p = third.inverse() * p;
                let across = (p.x.hypot(p.y) - radius).max(0.0);
                across.hypot((p.z.abs() - length).max(0.0))
            }),
        ),
        (
            Obstacle::points("cloud", fourth, &cloud, 0.01).expect("an obstacle"),
            Box::new(move |p| {
                let p = fourth.inverse() * p;
                let apart = points.iter().map(|q| (p - Point3::from(*q)).norm() - 0.01);
                apart.fold(f64::INFINITY, f64::min)
            }),
        ),
        (
            Obstacle::height_field("field", fifth, &heights, 5, [0.1, 0.2], 0.3)
                .expect("an obstacle"),
            Box::new(move |p| {
                let p = fifth.inverse() * p;
                let cell = |k: usize, height: f64| {
                    let centre =
                        Vector3::new(0.1 * (k % 5) as f64, 0.2 * (k / 5) as f64, height - 0.15);
                    box_apart(p - centre, [0.05, 0.1, 0.15])
                };
                let apart = field.iter().enumerate().map(|(k, height)| cell(k, *height));
                apart.fold(f64::INFINITY, f64::min)
            }),
        ),
        (
            // Far from the plane of its large face, the nearest point of this hull is its corner at the origin.
            Obstacle::hull("hull", Isometry3::translation(2.0, 2.0, 2.0), &tetrahedron)
                .expect("an obstacle"),
            Box::new(|p| (p - Point3::new(2.0, 2.0, 2.0)).norm()),
        ),
    ]
}

#[test]
fn covering_spheres_are_free_of_an_obstacle_only_where_they_are_apart() {
    let (_folder, robot) = robot_of("toy_all_joints");
    let mut numbers = Numbers(11);
    let level = level(&robot, &mut numbers, true);
    let checker =
        SphereChecker::covering(&robot, std::slice::from_ref(&level), &[]).expect("spheres");
    let asked = configurations(&robot, &mut numbers);
    for (obstacle, apart) in obstacles(&mut numbers) {
        let name = obstacle.name().to_owned();
        let around = checker.around(&World::new([obstacle.clone()])).expect("obstacles");
        // Moved there, an obstacle is the same.
        let away = obstacle.at(Isometry3::translation(5.0, 0.0, 0.0)).expect("a pose");
        let mut moved = checker.around(&World::new([away])).expect("obstacles");
        moved.move_obstacles(0, &[*obstacle.pose()]).expect("a pose");
        for q in &asked {
            let poses = robot.link_poses(q).expect("poses");
            let all = (0..poses.len()).flat_map(|link| placed(&poses, &level, link));
            let all: Vec<(Point3<f64>, f64)> = all.collect();
            if name == "hull" && all.iter().any(|(p, _)| p.coords.max() > 2.0) {
                continue;
            }
            let distance = all.iter().map(|(p, r)| apart(*p) - r).fold(f64::INFINITY, f64::min);
            let size: f64 = poses.iter().map(|pose| pose.translation.vector.norm()).sum();
            holds(&around, q, distance, size);
            assert_eq!(around.in_collision(q), moved.in_collision(q), "{name}");
        }
    }
}

#[test]
fn an_obstacle_ignores_links_and_a_batch_is_its_rows() {
    let (_folder, robot) = robot_of("six_axis_arm");
    let mut numbers = Numbers(3);
    let level = level(&robot, &mut numbers, false);
    let checker = SphereChecker::approximating(&robot, &[level], &[[0, 3], [1, 4], [2, 5]]);
    let checker = checker.expect("spheres");
    let ball = Obstacle::sphere("ball", [0.5, 0.1, 0.5], 0.2).expect("an obstacle");
    let around = checker.around(&World::new([ball.clone()])).expect("obstacles");
    let ignored =
        robot.link_names().expect("links").iter().fold(ball, |ball, link| ball.ignoring(link));
    let alone = checker.around(&World::new([ignored])).expect("obstacles");
    let space = robot.configurations().expect("configurations");
    let all: Vec<Vec<f64>> = (0..1003).map(|k| space.random(k)).collect();
    let batch = around.in_collision_batch(&all.concat()).expect("answers");
    for (q, answer) in all.iter().zip(&batch) {
        assert_eq!(around.in_collision(q), Ok(*answer));
        assert_eq!(alone.in_collision(q), checker.in_collision(q));
    }
    let contacts = batch.iter().filter(|answer| **answer == ApproximateAnswer::Contact).count();
    assert!(contacts > 50 && contacts < 950, "{contacts}");

    let settings = EdgeSettings { resolution: Some(0.02), ..EdgeSettings::default() };
    let mut first = vec![0.0; 2 * 500];
    let mut blocked = vec![0.0; 500];
    let edges = [&all[..500].concat()[..], &all[500..1000].concat()[..]];
    let on = Default::default();
    around.first_contact_batch_into(edges, &settings, &on, &mut first).expect("answers");
    around.blocked_edge_batch_into(edges, &settings, &on, &mut blocked).expect("answers");
    let mut between = 0;
    for (k, (first, any)) in first.chunks(2).zip(&blocked).enumerate() {
        let at = |part: f64| -> Vec<f64> {
            let ends = all[k].iter().zip(&all[500 + k]);
            ends.map(|(a, b)| if part == 1.0 { *b } else { a + part * (b - a) }).collect()
        };
        assert_eq!(first[0].is_nan(), any.is_nan());
        let touches = |part: f64| around.in_collision(&at(part)) == Ok(ApproximateAnswer::Contact);
        if any.is_nan() {
            assert!((0..=40).all(|k| !touches(f64::from(k) / 40.0)) || first[0].is_nan());
            continue;
        }
        assert!(touches(*any) && touches(first[1]), "{k}");
        assert!(first[1] <= *any);
        if first[1] > 0.0 {
            assert!(!touches(first[0]) && first[0] < first[1]);
            between += 1;
        }
    }
    assert!(between > 50, "{between}");
}

/// Between two configurations no sphere travels farther than the resolution: the box of the slide is found.
#[test]
fn a_sliding_sphere_has_closed_forms() {
    let (_folder, path) = made_of(SLIDE);
    let robot = Robot::open(path).expect("a robot");
    let sphere = |x: f64| vec![Sphere { centre: [x, 0.0, 0.0], radius: 0.1 }];
    let links = vec![
        LinkSpheres { link_idx: 0, spheres: sphere(-1.0) },
        LinkSpheres { link_idx: 1, spheres: sphere(0.0) },
    ];
    let level = SphereLevel { links, covers: true };
    let checker = SphereChecker::covering(&robot, &[level], &[[0, 1]]).expect("spheres");
    // They touch from -1.2 to -0.8.
    assert_eq!(checker.in_collision(&[-0.79]), Ok(CoveringAnswer::Free));
    assert_eq!(checker.in_collision(&[-0.81]), Ok(CoveringAnswer::Maybe));
    let settings = EdgeSettings::default();
    let contact =
        checker.first_contact(&[4.0], &[-2.0], &settings).expect("an answer").expect("a contact");
    assert!((contact.blocked - 4.8 / 6.0).abs() < 1e-5 && contact.free < contact.blocked);
    let margin = EdgeSettings { margin: 0.3, ..settings };
    let contact =
        checker.first_contact(&[4.0], &[-2.0], &margin).expect("an answer").expect("a contact");
    assert!((contact.blocked - 4.5 / 6.0).abs() < 1e-5);
    // A motion of one part is checked at both ends only.
    let coarse = EdgeSettings { resolution: Some(10.0), ..settings };
    assert_eq!(checker.blocked_edge(&[4.0], &[-2.0], &coarse), Ok(None));
    assert!(checker.blocked_edge(&[4.0], &[-2.0], &settings).expect("an answer").is_some());
    assert_eq!(checker.blocked_edge(&[4.0], &[-0.7], &settings), Ok(None));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let (_folder, path) = made_of(SLIDE);
    let robot = Robot::open(path).expect("a robot");
    let level = |link_idx: usize, centre: f64, radius: f64| SphereLevel {
        links: vec![LinkSpheres {
            link_idx,
            spheres: vec![Sphere { centre: [centre; 3], radius }],
        }],
        covers: false,
    };
    let made = |level: SphereLevel| SphereChecker::approximating(&robot, &[level], &[]).map(|_| ());
    for radius in [0.0, -1.0, f64::NAN, 1e300, f64::INFINITY] {
        let found = made(level(0, 0.0, radius));
        assert!(matches!(found, Err(RobotError::Sphere { link: 0, sphere: 0, .. })), "{found:?}");
    }
    for centre in [f64::NAN, 1e300] {
        assert!(matches!(made(level(1, centre, 0.1)), Err(RobotError::Sphere { link: 1, .. })));
    }
    assert!(matches!(made(level(2, 0.0, 0.1)), Err(RobotError::OutOfRange { .. })));
    assert!(SphereChecker::approximating(&robot, &[], &[]).is_err());
    assert!(SphereChecker::covering(&robot, &[level(0, 0.0, 0.1)], &[]).is_err());
    let checker =
        SphereChecker::approximating(&robot, &[level(1, 0.0, 0.1)], &[]).expect("spheres");
    assert_eq!(checker.in_collision(&[2e9]), Err(RobotError::Far { dof_idx: 0, value: 2e9 }));
    assert!(matches!(checker.in_collision(&[f64::NAN]), Err(RobotError::Configuration(_))));
    assert!(matches!(checker.in_collision(&[0.0, 0.0]), Err(RobotError::Configuration(_))));
    assert!(checker.is_within(&[0.0], f64::NAN).is_err());
    let proof = EdgeSettings { resolution: None, ..EdgeSettings::default() };
    assert!(matches!(checker.blocked_edge(&[0.0], &[1.0], &proof), Err(RobotError::Setting(_))));

    let pose = Isometry3::identity();
    for radius in [-1.0, f64::NAN, 1e300] {
        assert!(Obstacle::points("cloud", pose, &[[0.0; 3]], radius).is_err());
    }
    for point in [f64::NAN, f64::INFINITY, 1e300] {
        assert!(Obstacle::points("cloud", pose, &[[0.0; 3], [point, 0.0, 0.0]], 0.0).is_err());
        assert!(Obstacle::height_field("field", pose, &[point], 1, [0.1; 2], 0.1).is_err());
    }
    assert!(Obstacle::points("cloud", pose, &[], 0.0).is_err());
    assert!(Obstacle::points("cloud", pose, &[[0.0; 3]], 0.0).is_ok());
    assert!(Obstacle::height_field("field", pose, &[0.0; 7], 2, [0.1; 2], 0.1).is_err());
    assert!(Obstacle::height_field("field", pose, &[0.0; 7], 0, [0.1; 2], 0.1).is_err());
}

/// As many as a lidar map has: one more is refused with words, before memory is taken for it. To take them is 7 s and 500 MB.
#[test]
fn more_than_ten_million_points_are_refused() {
    const MOST: usize = 10_000_000;
    let pose = Isometry3::identity();
    let heights = vec![0.0; MOST + 1];
    let field = |heights: &[f64]| {
        Obstacle::height_field("field", pose, heights, 1, [0.01; 2], 0.1)
            .map_err(|it| it.to_string())
    };
    assert!(Obstacle::check_count("field", MOST).is_ok());
    let said = field(&heights).expect_err("too many");
    assert!(said.contains("there are 10000001 points, and 10000000 are allowed"), "{said}");
}

/// The shapes of a robot against a cloud are those against as many balls; against a field, as many boxes.
#[test]
fn a_cloud_is_its_points_and_a_field_its_columns() {
    let (_folder, robot) = robot_of("six_axis_arm");
    let proximity = robot.proximity(ShapeKind::Pieces).expect("shapes");
    let mut numbers = Numbers(5);
    let points: Vec<[f64; 3]> = (0..100).map(|_| numbers.vector(0.7)).collect();
    let heights: Vec<f64> = (0..60).map(|_| 0.5 * numbers.next()).collect();
    let pose = Isometry3::translation(1.0, 0.3, 0.2) * numbers.pose(0.3);
    let balls = points.iter().map(|p| {
        let at: [f64; 3] = (pose * Point3::from(*p)).coords.into();
        Obstacle::sphere("ball", at, 0.02).expect("an obstacle")
    });
    let columns = heights.iter().enumerate().map(|(k, height)| {
        let at = Isometry3::translation(0.1 * (k % 6) as f64, 0.2 * (k / 6) as f64, height - 0.2);
        Obstacle::cuboid("column", pose * at, [0.05, 0.1, 0.2]).expect("an obstacle")
    });
    let cloud = Obstacle::points("cloud", pose, &points, 0.02).expect("an obstacle");
    let field = Obstacle::height_field("field", pose, &heights, 6, [0.1, 0.2], 0.4);
    let field = field.expect("an obstacle");
    let space = robot.configurations().expect("configurations");
    for (many, one) in [(World::new(balls), cloud), (World::new(columns), field)] {
        let many = proximity.world_proximity(&many).expect("a world");
        let one = proximity.world_proximity(&World::new([one])).expect("a world");
        assert_eq!(one.num_pairs(), proximity.num_shapes());
        let mut contacts = 0;
        for k in 0..60 {
            let q = space.random(k);
            let [expected, found] =
                [&many, &one].map(|world| world.in_collision(&q).expect("an answer"));
            assert_eq!(found, expected, "{k}");
            contacts += usize::from(found);
            let [expected, found] =
                [&many, &one].map(|world| world.min_distance(&q).expect("an answer"));
            let [expected, found] = [expected, found].map(|distance| distance.expect("pairs"));
            assert!((expected - found).abs() < 2e-9, "{k}: {expected} {found}");
            let expected = &many.nearest(&q, 1).expect("pairs")[0];
            let found = &one.nearest(&q, 1).expect("pairs")[0];
            assert!((expected.distance - found.distance).abs() < 2e-9);
            let apart = Vector3::from(found.points[0]) - Vector3::from(found.points[1]);
            assert!((apart.norm() - found.distance).abs() < 1e-8);
            assert_eq!(many.is_within(&q, 0.05), one.is_within(&q, 0.05));
        }
        assert!(contacts > 0 && contacts < 60, "{contacts}");
    }
    // What a link carries is not many things.
    let cloud = Obstacle::points("cloud", pose, &points, 0.0).expect("an obstacle");
    assert!(matches!(proximity.attach(1, &cloud), Err(RobotError::Obstacle { .. })));
}

/// Where spheres around shapes are free, so are the shapes.
#[test]
fn what_spheres_around_shapes_call_free_is_free() {
    let (mut free, mut contacts) = (0, 0);
    for name in ["six_axis_arm", "quadruped", "welding_arm", "hand"] {
        let (_folder, robot) = robot_of(name);
        let space = robot.configurations().expect("configurations");
        let batch: Vec<f64> = (0..300).flat_map(|k| space.random(k)).collect();
        for kind in [ShapeKind::Hulls, ShapeKind::Pieces] {
            let all = robot.proximity_of(kind, |_| true).expect("shapes");
            for proximity in [all, robot.proximity(kind).expect("shapes")] {
                let (levels, pairs) = ([proximity.bounding_level()], proximity.link_pairs());
                let spheres = SphereChecker::covering(&robot, &levels, &pairs).expect("spheres");
                let spheres = spheres.in_collision_batch(&batch).expect("answers");
                let shapes = proximity.in_collision_batch(&batch).expect("answers");
                for (spheres, touches) in spheres.into_iter().zip(shapes) {
                    assert!(!(touches && spheres == CoveringAnswer::Free), "{name}");
                    free += usize::from(spheres == CoveringAnswer::Free);
                    contacts += usize::from(touches);
                }
            }
        }
    }
    assert!(free > 10 && contacts > 1000, "{free} {contacts}");
}
