//! Distances to obstacles: closed forms, parry, and the same bodies as links of the robot.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::{Capsule, ConvexPolyhedron, Cuboid, Shape};
use urdd_geometry::Mesh;
use urdd_robot::{Obstacle, ObstacleDistance, Queries, Robot, RobotError, ShapeKind, World};

use testkit::robots::{made, made_of, our_robots};

/// A block of 0.2 m that slides along x, and one that turns about z a metre away from the axis.
const MOVERS: &str = r#"<robot name="movers">
  <link name="base"/>
  <link name="block"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <link name="ball"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="slide" type="prismatic"><parent link="base"/><child link="block"/><axis xyz="1 0 0"/>
    <limit lower="-5" upper="5" effort="1" velocity="1"/></joint>
  <joint name="turn" type="continuous"><parent link="base"/><child link="ball"/><axis xyz="0 0 1"/></joint>
</robot>"#;

fn of<'a>(all: &'a [ObstacleDistance], link: &str, obstacle: &str) -> &'a ObstacleDistance {
    let wanted = |one: &&ObstacleDistance| *one.link == *link && *one.obstacle == *obstacle;
    all.iter().find(wanted).unwrap_or_else(|| panic!("{link} and {obstacle}"))
}

fn at(x: f64, y: f64, z: f64) -> Isometry3<f64> {
    Isometry3::translation(x, y, z)
}

#[test]
fn bodies_as_their_sizes_have_them() {
    let (_folder, path) = made_of(MOVERS);
    let robot = Robot::open(path).unwrap();
    let quarter = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::FRAC_PI_2);
    let lying = Isometry3::from_parts(Translation3::new(0.0, 0.0, 2.0), quarter);
    let world = World::new([
        Obstacle::cuboid("wall", at(3.0, 0.0, 0.0), [0.5, 2.0, 2.0]).unwrap(),
        Obstacle::sphere("sun", [0.0, 3.0, 0.0], 0.5).unwrap(),
        Obstacle::capsule("bar", lying, 0.25, 10.0).unwrap(),
        Obstacle::cylinder("mast", at(0.0, -3.0, 0.0), 0.5, 4.0).unwrap(),
    ]);
    let proximity = robot.proximity(ShapeKind::Boxes).unwrap();
    let among = proximity.world_proximity(&world).unwrap();
    for q in [-0.7, 0.0, 1.1] {
        let all = among.closest_points(&[q, 0.0]).unwrap();
        assert_eq!(all.len(), 8);
        let wall = of(&all, "block", "wall");
        assert!((wall.distance - (2.4 - q)).abs() < 1e-7, "{wall:?}");
        assert!((wall.points[0][0] - (q + 0.1)).abs() < 1e-7, "{wall:?}");
        assert!((wall.points[1][0] - 2.5).abs() < 1e-7, "{wall:?}");
        // The bar is along x, over the block.
        let bar = of(&all, "block", "bar");
        assert!((bar.distance - (1.9 - 0.25)).abs() < 1e-7, "{bar:?}");
        assert!((bar.points[1][2] - 1.75).abs() < 1e-7, "{bar:?}");
        let sun = of(&all, "block", "sun");
        let beside = (q.abs() - 0.1).max(0.0);
        let expected = (2.9_f64.powi(2) + beside * beside).sqrt() - 0.5;
        assert!((sun.distance - expected).abs() < 1e-7, "{sun:?}");
        // A prism around a cylinder: nearer by at most 0.13 % of its radius.
        let mast = of(&all, "block", "mast");
        let exact = (2.9_f64.powi(2) + beside * beside).sqrt() - 0.5;
        let short = exact - mast.distance;
        assert!((-1e-9..=0.5 * 0.0013).contains(&short), "{mast:?}");
    }
    let hit = among.closest_points(&[2.45, 0.0]).unwrap();
    let hit = of(&hit, "block", "wall");
    assert_eq!((hit.distance, hit.points[0]), (0.0, hit.points[1]));
    assert!(among.in_collision(&[2.45, 0.0]).unwrap());
    assert!(!among.in_collision(&[2.39, 0.0]).unwrap());
}

#[test]
fn spheres_reach_as_far_as_their_radii() {
    let (_folder, path) = made_of(MOVERS);
    let robot = Robot::open(path).unwrap();
    let world = World::new([Obstacle::sphere("sun", [0.0, 3.0, 0.0], 0.5).unwrap()]);
    let proximity = robot.proximity(ShapeKind::Spheres).unwrap();
    let among = proximity.world_proximity(&world).unwrap();
    let ball = &among.closest_points(&[0.0, std::f64::consts::FRAC_PI_2]).unwrap()[1];
    assert!((ball.distance - 1.4).abs() < 1e-6, "{ball:?}");
    assert!((ball.points[0][1] - 1.1).abs() < 1e-6 && (ball.points[1][1] - 2.5).abs() < 1e-6);
    // Deep penetration: one point common to both.
    let world = World::new([Obstacle::sphere("sun", [0.9, 0.0, 0.0], 0.5).unwrap()]);
    let among = proximity.world_proximity(&world).unwrap();
    let ball = &among.closest_points(&[-3.0, 0.0]).unwrap()[1];
    assert_eq!((ball.distance, ball.points[0]), (0.0, ball.points[1]));
    let from = |centre: [f64; 3]| -> f64 {
        let d = [0, 1, 2].map(|k| ball.points[0][k] - centre[k]);
        d.iter().map(|x| x * x).sum::<f64>().sqrt()
    };
    assert!(from([1.0, 0.0, 0.0]) <= 0.1 + 1e-6 && from([0.9, 0.0, 0.0]) <= 0.5);
    assert!(among.in_collision(&[-3.0, 0.0]).unwrap());
}

/// A cup with walls 0.1 m thick, open at the top, around the origin: 1 m wide and high.
fn cup() -> Mesh {
    let mut mesh = Mesh::default();
    for (centre, half) in [
        ([0.0, 0.0, -0.45], [0.5, 0.5, 0.05]),
        ([0.45, 0.0, 0.05], [0.05, 0.5, 0.45]),
        ([-0.45, 0.0, 0.05], [0.05, 0.5, 0.45]),
        ([0.0, 0.45, 0.05], [0.4, 0.05, 0.45]),
        ([0.0, -0.45, 0.05], [0.4, 0.05, 0.45]),
    ] {
        let first = mesh.vertices.len() as u32;
        for i in 0..8 {
            let sign = |bit: usize| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
            mesh.vertices.push([0, 1, 2].map(|k: usize| centre[k] + sign(k) * half[k]));
        }
        for [a, b, c, d] in
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        {
            for t in [[a, b, c], [a, c, d]] {
                mesh.triangles.push(t.map(|v: u32| first + v));
            }
        }
    }
    mesh
}

#[test]
fn a_mesh_keeps_its_cavity_and_a_hull_fills_it() {
    let (_folder, path) = made_of(MOVERS);
    let robot = Robot::open(path).unwrap();
    let proximity = robot.proximity(ShapeKind::Pieces).unwrap();
    let cup = cup();
    let pieces = Obstacle::mesh("cup", at(0.0, 0.0, 0.0), &cup).unwrap();
    let hull = Obstacle::hull("cup", at(0.0, 0.0, 0.0), &cup.vertices).unwrap();
    assert!(pieces.num_parts() >= 5, "{}", pieces.num_parts());
    assert_eq!(hull.num_parts(), 1);
    // The block is in the middle of the cup, the ball outside.
    let q = [0.0, 0.0];
    let world = World::new([pieces]);
    let all = proximity.world_proximity(&world).unwrap().closest_points(&q).unwrap();
    let inside = of(&all, "block", "cup");
    assert!((inside.distance - 0.3).abs() < 2e-4, "{inside:?}");
    let among = proximity.world_proximity(&world).unwrap();
    let values = among.distances(&q).unwrap();
    // One for each shape, of the nearest part.
    assert_eq!(values.len(), all.len());
    for (value, one) in values.iter().zip(&all) {
        assert!((value - one.distance).abs() < 1e-12, "{value} {one:?}");
    }
    let world = World::new([hull]);
    assert!(proximity.world_proximity(&world).unwrap().in_collision(&q).unwrap());
}

#[test]
fn as_parry_has_it() {
    let ours = our_robots();
    let (_, urdf) = ours.iter().find(|(name, _)| name == "welding_arm").unwrap();
    let (_folder, path) = made(urdf);
    let robot = Robot::open(path).unwrap();
    let proximity = robot.proximity(ShapeKind::Hulls).unwrap();
    let turned = UnitQuaternion::from_euler_angles(0.4, -0.7, 1.1);
    let pose = Isometry3::from_parts(Translation3::new(0.4, 0.2, 0.4), turned);
    let axis = turned.scaled_axis();
    let theirs = Pose::new(Vector::new(0.4, 0.2, 0.4), Vector::new(axis.x, axis.y, axis.z));
    let world = World::new([
        Obstacle::cuboid("box", pose, [0.2, 0.3, 0.1]).unwrap(),
        Obstacle::capsule("rod", pose, 0.1, 0.3).unwrap(),
    ]);
    let rod = Capsule::new(Vector::new(0.0, 0.0, -0.3), Vector::new(0.0, 0.0, 0.3), 0.1);
    let block = Cuboid::new(Vector::new(0.2, 0.3, 0.1));
    let bodies: [(&str, &dyn Shape); 2] = [("box", &block), ("rod", &rod)];
    let among = proximity.world_proximity(&world).unwrap();
    let (mut apart, mut together) = (0, 0);
    for seed in 0..40 {
        let q = robot.configurations().unwrap().random(seed);
        let poses = robot.link_poses(&q).unwrap();
        let all = among.closest_points(&q).unwrap();
        let values: Vec<f64> = all.iter().map(|one| one.distance).collect();
        let without_points = among.distances(&q).unwrap();
        assert_eq!(without_points.len(), values.len());
        for (one, other) in without_points.iter().zip(&values) {
            assert!((one - other).abs() < 1e-12, "{one} {other}");
        }
        let pairs: Vec<([usize; 2], usize)> =
            all.iter().map(|one| ([one.link_idx, one.piece], one.obstacle_idx)).collect();
        assert_eq!(among.pairs().collect::<Vec<_>>(), pairs);
        let mut nearest = all.clone();
        nearest.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        assert_eq!(among.nearest(&q, 1).unwrap()[0].distance, nearest[0].distance);
        assert_eq!(
            among.min_distance(&q).unwrap(),
            without_points.iter().copied().reduce(f64::min)
        );
        assert_eq!(among.in_collision(&q).unwrap(), nearest[0].distance == 0.0);
        for one in &all {
            let shape = robot.shapes(ShapeKind::Hulls).unwrap();
            let shape = shape.iter().find(|shape| shape.link == one.link_idx).unwrap();
            let urdd_robot::Solid::Mesh(mesh) = &shape.solid else {
                panic!("a hull is a mesh");
            };
            let placed = mesh.vertices.iter().map(|v| {
                let [x, y, z] = (poses[one.link_idx] * nalgebra::Point3::from(*v)).coords.into();
                Vector::new(x, y, z)
            });
            let hull = ConvexPolyhedron::from_convex_hull(&placed.collect::<Vec<_>>()).unwrap();
            let (_, body) = bodies.iter().find(|(name, _)| **name == *one.obstacle).unwrap();
            let distance =
                query::distance(&Pose::identity(), &hull, &theirs, *body).unwrap().distance;
            assert!((distance - one.distance).abs() < 2e-6, "{distance} {one:?}");
            match one.distance > 0.0 {
                true => apart += 1,
                false => together += 1,
            }
        }
    }
    assert!(apart > 100 && together > 5, "{apart} {together}");
}

#[test]
fn links_that_an_obstacle_ignores() {
    let (_folder, path) = made_of(MOVERS);
    let robot = Robot::open(path).unwrap();
    let proximity = robot.proximity(ShapeKind::Pieces).unwrap();
    let table = Obstacle::cuboid("table", at(0.0, 0.0, -0.2), [0.5, 0.5, 0.15]).unwrap();
    let q = [0.0, 0.0];
    let world = World::new([table.clone()]);
    assert!(proximity.world_proximity(&world).unwrap().in_collision(&q).unwrap());
    let world = World::new([table.clone().ignoring("block")]);
    let among = proximity.world_proximity(&world).unwrap();
    assert!(!among.in_collision(&q).unwrap());
    let all = among.nearest(&q, 10).unwrap();
    assert_eq!(all.len(), 1);
    assert_eq!(&*all[0].link, "ball");
    let wrong = World::new([table.ignoring("blok")]);
    match proximity.world_proximity(&wrong) {
        Err(RobotError::Unknown { name, nearest, .. }) => {
            assert_eq!((name.as_str(), nearest.as_deref()), ("blok", Some("block")));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_no_body_is_refused() {
    let here = Isometry3::identity();
    let far = at(f64::NAN, 0.0, 0.0);
    for result in [
        Obstacle::sphere("bad", [0.0; 3], -1.0),
        Obstacle::sphere("bad", [f64::INFINITY, 0.0, 0.0], 1.0),
        Obstacle::cuboid("bad", here, [1.0, f64::NAN, 1.0]),
        Obstacle::cuboid("bad", far, [1.0; 3]),
        Obstacle::capsule("bad", here, 1.0, 1e10),
        Obstacle::cylinder("bad", here, f64::INFINITY, 1.0),
        Obstacle::hull("bad", here, &[]),
        Obstacle::mesh("bad", here, &Mesh::default()),
    ] {
        let error = result.expect_err("refused");
        assert!(matches!(&error, RobotError::Obstacle { name, .. } if name == "bad"));
    }
}

/// Obstacles of every kind that are moved, by each way, are those that are made there: from points that are moved before.
#[test]
fn moved_obstacles_are_those_that_are_made_there() {
    let ours = our_robots();
    let (_, urdf) = ours.iter().find(|(name, _)| name == "welding_arm").unwrap();
    let (_folder, path) = made(urdf);
    let robot = Robot::open(path).unwrap();
    let space = robot.configurations().unwrap();
    let proximity = robot.proximity(ShapeKind::Pieces).unwrap();
    let far = at(900.0, -4000.0, 50.0);
    let make = |pose: Isometry3<f64>| {
        [
            Obstacle::cuboid("box", pose, [0.1, 0.2, 0.05]).unwrap(),
            Obstacle::capsule("rod", pose, 0.05, 0.2).unwrap(),
            Obstacle::cylinder("mast", pose, 0.1, 0.3).unwrap(),
            Obstacle::sphere("ball", pose.translation.vector.into(), 0.1).unwrap(),
            Obstacle::mesh("cup", pose, &cup()).unwrap(),
        ]
    };
    // Hulls of points that are in the root link's frame.
    let placed = |pose: &Isometry3<f64>| {
        let corner = |i: usize| {
            [(1, 0.1), (2, 0.2), (4, 0.05)]
                .map(|(bit, half)| if i & bit == 0 { -half } else { half })
        };
        let corners = (0..8).map(|i| (pose * nalgebra::Point3::from(corner(i))).coords.into());
        let corners: Vec<[f64; 3]> = corners.collect();
        Obstacle::hull("box", Isometry3::identity(), &corners).unwrap()
    };
    let elsewhere = World::new(make(far));
    let mut moving = proximity.world_proximity(&elsewhere).unwrap();
    for k in 0..20 {
        let x = f64::from(k);
        let turned = match k {
            0 => UnitQuaternion::identity(),
            _ => UnitQuaternion::from_euler_angles(x, 0.7 * x, 1.3 * x),
        };
        let pose = Isometry3::from_parts(Translation3::new(0.6 - 0.05 * x, 0.03 * x, 0.3), turned);
        let here = proximity.world_proximity(&World::new(make(pose))).unwrap();
        let mut world = elsewhere.clone();
        for one in elsewhere.obstacles() {
            world.put(one.at(pose).unwrap());
        }
        let put = proximity.world_proximity(&world).unwrap();
        moving.move_obstacles(0, &[pose; 5]).unwrap();
        let alone = proximity.world_proximity(&World::new([placed(&pose)])).unwrap();
        for seed in 0..10 {
            let q = space.random(seed);
            let expected = here.closest_points(&q).unwrap();
            assert_eq!(put.closest_points(&q).unwrap(), expected);
            assert_eq!(moving.closest_points(&q).unwrap(), expected);
            assert_eq!(moving.penetrations(&q), here.penetrations(&q));
            let boxes = expected.iter().filter(|one| &*one.obstacle == "box");
            for (one, other) in boxes.zip(alone.closest_points(&q).unwrap()) {
                assert!((one.distance - other.distance).abs() < 1e-9, "{one:?} {other:?}");
            }
            let least = expected.iter().map(|one| one.distance).fold(f64::INFINITY, f64::min);
            assert_eq!(moving.min_distance(&q), Ok(Some(least)));
            assert_eq!(moving.in_collision(&q), Ok(least == 0.0));
            for margin in [0.01, 0.1] {
                assert_eq!(moving.is_within(&q, margin), Ok(least <= margin));
            }
        }
    }
    // One of them alone; what is refused moves none.
    let (q, near) = (space.zero(), at(0.5, 0.0, 0.3));
    moving.move_obstacles(0, &[far; 5]).unwrap();
    moving.move_obstacles(3, &[near]).unwrap();
    let before = moving.distances(&q).unwrap();
    let moved: Vec<&str> = (moving.nearest(&q, 3).unwrap().iter())
        .map(|one| if one.distance < 100.0 { "ball" } else { "another" })
        .collect();
    assert_eq!(moved, ["ball"; 3]);
    for (first, poses) in [(0, vec![near; 6]), (5, vec![near]), (usize::MAX, vec![near; 2])] {
        let refused = moving.move_obstacles(first, &poses);
        assert!(matches!(refused, Err(RobotError::OutOfRange { count: 5, .. })), "{refused:?}");
    }
    for wrong in [at(f64::NAN, 0.0, 0.0), at(0.0, 1e10, 0.0)] {
        let refused = moving.move_obstacles(0, &[near, wrong]);
        assert!(matches!(refused, Err(RobotError::Obstacle { name, .. }) if name == "rod"));
        assert!(elsewhere.obstacles()[0].at(wrong).is_err());
    }
    assert_eq!(moving.distances(&q).unwrap(), before);
}

#[test]
fn many_at_once_are_each_by_itself() {
    let (_folder, path) = made(&our_robots()[8].1);
    let robot = Robot::open(path).unwrap();
    let proximity = robot.proximity(ShapeKind::Pieces).unwrap();
    let slab = Obstacle::cuboid("slab", at(0.8, 0.0, 0.25), [0.5, 0.5, 0.05]).unwrap();
    let ball = Obstacle::sphere("ball", [0.5, 0.0, 0.5], 0.1).unwrap();
    let around = proximity.world_proximity(&World::new([slab, ball])).unwrap();
    let all: Vec<Vec<f64>> = (0..50).map(|k| robot.configurations().unwrap().random(k)).collect();
    let (batch, pairs) = (all.concat(), around.num_pairs());
    let (collide, least) =
        (around.in_collision_batch(&batch).unwrap(), around.min_distance_batch(&batch).unwrap());
    let values = around.distances_batch(&batch).unwrap();
    assert!(collide.contains(&true) && collide.contains(&false));
    for (k, q) in all.iter().enumerate() {
        let found = around.closest_points(q).unwrap();
        let distances: Vec<f64> = found.iter().map(|one| one.distance).collect();
        for (one, other) in distances.iter().zip(&values[k * pairs..(k + 1) * pairs]) {
            assert!((one - other).abs() < 1e-9);
        }
        assert_eq!(values[k * pairs..(k + 1) * pairs], around.distances(q).unwrap());
        assert_eq!(
            (collide[k], Some(least[k])),
            (least[k] == 0.0, around.min_distance(q).unwrap())
        );
        let touching = around.collisions(q).unwrap();
        assert_eq!(touching.len(), distances.iter().filter(|distance| **distance == 0.0).count());
    }
}
