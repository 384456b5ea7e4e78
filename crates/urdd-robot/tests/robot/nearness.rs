use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use testkit::trials::sample;
use urdd_robot::{Obstacle, PairDistance, Queries, Robot, ShapeKind, World};

use super::planning::robot_of;
use testkit::robots::{made, made_of, our_robots};

/// A cube of 1 m, and one of 0.2 m that slides along x, 2 m away; a ball of 0.1 m that slides along y.
const SLIDERS: &str = r#"<robot name="sliders">
  <link name="cube"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="rail"/>
  <link name="block"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <link name="pole"/>
  <link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="x" type="prismatic"><parent link="cube"/><child link="rail"/><axis xyz="1 0 0"/>
    <limit lower="-3" upper="1" effort="1" velocity="1"/></joint>
  <joint name="on_rail" type="fixed"><parent link="rail"/><child link="block"/><origin xyz="2 0 0"/></joint>
  <joint name="y" type="prismatic"><parent link="cube"/><child link="pole"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="1" effort="1" velocity="1"/></joint>
  <joint name="on_pole" type="fixed"><parent link="pole"/><child link="ball"/><origin xyz="0 1.5 0"/></joint>
</robot>"#;

fn pair<'a>(pairs: &'a [PairDistance], a: &str, b: &str) -> &'a PairDistance {
    let wanted = |pair: &&PairDistance| *pair.links[0] == *a && *pair.links[1] == *b;
    pairs.iter().find(wanted).unwrap_or_else(|| panic!("{a} and {b}"))
}

#[test]
fn blocks_as_their_sizes_have_them() {
    let (_folder, path) = made_of(SLIDERS);
    let robot = Robot::open(path).unwrap();
    for kind in [ShapeKind::Hulls, ShapeKind::Boxes, ShapeKind::Pieces, ShapeKind::PieceBoxes] {
        let proximity = robot.proximity(kind).unwrap();
        assert_eq!((proximity.num_pairs(), proximity.num_shapes()), (3, 3), "{kind}");
        for q in [-0.3, 0.0, 0.7, -1.39] {
            let pairs = proximity.closest_points(&[q, 1.0]).unwrap();
            let pair = pair(&pairs, "cube", "block");
            assert!((pair.distance - (1.4 + q)).abs() < 1e-7, "{kind}: {pair:?}");
            let [on_cube, on_block] = pair.points;
            assert!((on_cube[0] - 0.5).abs() < 1e-7 && (on_block[0] - (1.9 + q)).abs() < 1e-7);
            assert!(on_cube[1].abs() <= 0.5 + 1e-7 && on_block[1].abs() <= 0.1 + 1e-7);
            assert!((on_cube[1] - on_block[1]).abs() < 1e-7, "{pair:?}");
        }
        // The block in the cube: exactly at its centre, and through its side.
        for q in [-2.0, -1.5] {
            let pairs = proximity.closest_points(&[q, 1.0]).unwrap();
            let pair = pair(&pairs, "cube", "block");
            assert_eq!(pair.distance, 0.0);
            assert_eq!(pair.points[0], pair.points[1]);
            let [x, y, z] = pair.points[0];
            assert!((x - (2.0 + q)).abs() <= 0.1 + 1e-7 && x <= 0.5 + 1e-7, "{pair:?}");
            assert!(y.abs() <= 0.1 + 1e-7 && z.abs() <= 0.1 + 1e-7, "{pair:?}");
            assert!(proximity.in_collision(&[q, 1.0]).unwrap());
            assert_eq!(proximity.collisions(&[q, 1.0]).unwrap().len(), 1);
        }
        assert!(!proximity.in_collision(&[-1.39, 1.0]).unwrap());
        assert_eq!(proximity.collisions(&[0.0, 1.0]).unwrap(), []);
    }
    let spheres = robot.proximity(ShapeKind::Spheres).unwrap();
    let pairs = spheres.closest_points(&[0.5, 0.5]).unwrap();
    // The sphere around a box reaches its corners; that around the ball is the ball.
    let found = pair(&pairs, "cube", "block").distance;
    assert!((found - (2.5 - 0.6 * f64::sqrt(3.0))).abs() < 1e-6, "{found}");
    let found = pair(&pairs, "cube", "ball");
    assert!((found.distance - (2.0 - 0.5 * f64::sqrt(3.0) - 0.1)).abs() < 1e-6, "{found:?}");
    assert!((found.points[1][1] - 1.9).abs() < 1e-6, "{found:?}");
}

#[test]
fn relative_distances_are_by_the_mean_that_is_recorded() {
    let (_folder, path) = made_of(SLIDERS);
    let robot = Robot::open(&path).unwrap();
    let text = std::fs::read_to_string(
        path.join("link_shapes_modules/link_shapes_distance_statistics_module/module.json"),
    )
    .unwrap();
    let module: serde_json::Value = serde_json::from_str(&text).unwrap();
    let mean = module["full_convex_hulls"]["mean_distances"][0][1].as_f64().unwrap();
    let proximity = robot.proximity(ShapeKind::Hulls).unwrap();
    let pairs = proximity.closest_points(&[0.0, 0.0]).unwrap();
    let relative = pair(&pairs, "cube", "block").relative.unwrap();
    assert!((relative - 1.4 / mean).abs() < 1e-6, "{relative}");
}

#[test]
fn edits_of_skips_decide() {
    let (_folder, path) = made_of(SLIDERS);
    let count = |path: &std::path::Path| {
        let robot = Robot::open(path).unwrap();
        robot.proximity(ShapeKind::Pieces).unwrap().num_pairs()
    };
    assert_eq!(count(&path), 3);
    let file = path.join("link_shapes_modules/link_shapes_skips_module/module.json");
    let text = std::fs::read_to_string(&file).unwrap();
    let mut module: serde_json::Value = serde_json::from_str(&text).unwrap();
    for (i, j) in [(0, 1), (1, 0)] {
        module["decomposition_convex_hulls_skips"][i][j] = true.into();
    }
    std::fs::write(&file, module.to_string()).unwrap();
    assert_eq!(count(&path), 2);
    // If the matrices of pieces are omitted, the links decide.
    module["decomposition_convex_hulls_skips"] = serde_json::Value::Null;
    std::fs::write(&file, module.to_string()).unwrap();
    assert_eq!(count(&path), 3);
    for (i, j) in [(0, 2), (2, 0), (1, 2), (2, 1)] {
        module["full_convex_hulls_skips"][i][j] = true.into();
    }
    std::fs::write(&file, module.to_string()).unwrap();
    assert_eq!(count(&path), 1);
}

/// The distances of all pairs that are not skipped, one by one, without culling.
fn one_by_one(robot: &Robot, kind: ShapeKind, q: &[f64]) -> Vec<f64> {
    use urdd_geometry::convex::{ConvexShape, distance};
    use urdd_robot::Solid;
    let skips = robot.skips(kind).unwrap();
    let poses = robot.link_poses(q).unwrap();
    let shapes: Vec<_> = robot
        .shapes(kind)
        .unwrap()
        .into_iter()
        .map(|shape| match shape.solid {
            Solid::Mesh(mesh) => (shape.link, ConvexShape::new(&mesh).unwrap()),
            other => panic!("{other:?}"),
        })
        .collect();
    let mut found = Vec::new();
    for i in 0..shapes.len() {
        for j in i + 1..shapes.len() {
            if !skips.is_skipped(i, j) {
                let (a, b) = (&shapes[i], &shapes[j]);
                found.push(distance(&a.1, &b.1, &poses[a.0].inv_mul(&poses[b.0])));
            }
        }
    }
    found
}

#[test]
fn every_question_agrees_with_each_pair_asked_alone() {
    let mut collisions = [0, 0];
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).unwrap();
        for kind in [ShapeKind::Hulls, ShapeKind::Pieces] {
            let proximity = robot.proximity(kind).unwrap();
            let space = robot.configurations().unwrap();
            for k in sample(0..12, 3) {
                let q = match k {
                    0 => space.zero(),
                    k => space.random(k),
                };
                let mut expected = one_by_one(&robot, kind, &q);
                expected.sort_by(f64::total_cmp);
                let pairs = proximity.closest_points(&q).unwrap();
                let values = proximity.distances(&q).unwrap();
                assert!(pairs.iter().zip(&values).all(|(pair, value)| pair.distance == *value));
                for pair in &pairs {
                    let apart = (0..3).map(|k| (pair.points[0][k] - pair.points[1][k]).powi(2));
                    let apart = apart.sum::<f64>().sqrt();
                    assert!((apart - pair.distance).abs() < 2e-9, "{name}: {pair:?}");
                }
                let mut found = values.clone();
                found.sort_by(f64::total_cmp);
                assert_eq!(found.len(), expected.len(), "{name}");
                let off = found.iter().zip(&expected).map(|(a, b)| (a - b).abs());
                assert!(off.fold(0.0, f64::max) < 3e-9, "{name}, {kind}, {k}");
                let nearest = proximity.nearest(&q, 5).unwrap();
                let least: Vec<f64> = nearest.iter().map(|pair| pair.distance).collect();
                assert_eq!(least, found[..found.len().min(5)], "{name}, {kind}, {k}");
                assert_eq!(proximity.self_distance(&q).unwrap(), found.first().copied());
                let collides = expected.first() == Some(&0.0);
                assert_eq!(proximity.in_collision(&q).unwrap(), collides, "{name}, {kind}, {k}");
                let touching = expected.iter().filter(|distance| **distance == 0.0).count();
                assert_eq!(proximity.collisions(&q).unwrap().len(), touching);
                collisions[usize::from(collides)] += 1;
            }
        }
    }
    assert!(collisions.iter().all(|count| *count > 6), "{collisions:?}");
}

#[test]
fn points_of_the_least_distance_are_in_their_shapes() {
    use urdd_robot::Solid;
    let (_folder, path) = made(&our_robots()[8].1);
    let robot = Robot::open(path).unwrap();
    let proximity = robot.proximity(ShapeKind::Pieces).unwrap();
    let shapes = robot.shapes(ShapeKind::Pieces).unwrap();
    let outside = |link: usize, piece: usize, point: nalgebra::Point3<f64>| {
        let own = |shape: &&urdd_robot::LinkShape| (shape.link, shape.piece) == (link, piece);
        let Solid::Mesh(mesh) = &shapes.iter().find(own).unwrap().solid else {
            panic!("a mesh");
        };
        mesh.triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = triangle.map(|i| nalgebra::Point3::from(mesh.vertices[i as usize]));
                let normal = (b - a).cross(&(c - a)).try_normalize(1e-12).unwrap_or_default();
                normal.dot(&(point - a))
            })
            .fold(f64::NEG_INFINITY, f64::max)
    };
    let mut touching = 0;
    for k in 0..30 {
        let q = robot.configurations().unwrap().random(k);
        let poses = robot.link_poses(&q).unwrap();
        for pair in proximity.closest_points(&q).unwrap() {
            touching += usize::from(pair.distance == 0.0);
            for side in [0, 1] {
                let (link, piece) = (pair.link_idxs[side], pair.pieces[side]);
                let point = poses[link].inverse() * nalgebra::Point3::from(pair.points[side]);
                let out = outside(link, piece, point);
                assert!(out < 1e-6, "{out} of {pair:?}");
            }
        }
    }
    assert!(touching > 30, "{touching}");
}

#[test]
fn many_at_once_are_each_by_itself_for_any_number_of_threads() {
    let (_folder, path) = made(&our_robots()[8].1);
    let robot = Robot::open(path).unwrap();
    let proximity = robot.proximity(ShapeKind::Pieces).unwrap();
    let all: Vec<Vec<f64>> = (0..100).map(|k| robot.configurations().unwrap().random(k)).collect();
    let batch = all.concat();
    let ask = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            (
                proximity.in_collision_batch(&batch).unwrap(),
                proximity.min_distance_batch(&batch).unwrap(),
                proximity.distances_batch(&batch).unwrap(),
            )
        })
    };
    let (collide, least, values) = ask(1);
    assert_eq!((collide.clone(), least.clone(), values.clone()), ask(3));
    for (k, q) in all.iter().enumerate() {
        assert_eq!(collide[k], proximity.in_collision(q).unwrap());
        assert_eq!(Some(least[k]), proximity.self_distance(q).unwrap());
        let own = &values[k * proximity.num_pairs()..(k + 1) * proximity.num_pairs()];
        assert_eq!(own, proximity.distances(q).unwrap());
    }
    assert!(proximity.in_collision_batch(&batch[1..]).is_err());
    assert!(proximity.in_collision(&[f64::INFINITY; 6]).is_err());
}

/// Of pairs that are told apart by spheres, by boxes and in groups, the answers are those of all distances, bit by bit.
#[test]
fn answers_are_those_of_all_distances() {
    let boxes = (0..20).map(|k| {
        let turn = f64::from(k);
        let at = Translation3::new(0.8 * turn.cos(), 0.8 * turn.sin(), 0.06 * turn);
        let pose =
            Isometry3::from_parts(at, UnitQuaternion::from_euler_angles(turn, 0.7 * turn, 0.0));
        Obstacle::cuboid(&k.to_string(), pose, [0.05, 0.1, 0.2]).unwrap()
    });
    let world = World::new(boxes);
    let mut contacts = [[0; 2]; 2];
    for name in ["six_axis_arm", "quadruped", "welding_arm", "hand"] {
        let (_folder, robot) = robot_of(name);
        let space = robot.configurations().unwrap();
        for kind in [ShapeKind::Pieces, ShapeKind::PieceSpheres] {
            let shapes = robot.proximity(kind).unwrap();
            let object = Obstacle::capsule("object", Isometry3::identity(), 0.05, 0.1).unwrap();
            let shapes = shapes.attach(robot.link_names().unwrap().len() - 1, &object).unwrap();
            let around = shapes.world_proximity(&world).unwrap();
            let moves: Vec<bool> = shapes
                .pairs()
                .map(|[(a, _), (b, _)]| !robot.dofs_between(a, b).unwrap().is_empty())
                .collect();
            for k in 0..1250 {
                let q = space.random(k);
                let count = &mut contacts[usize::from(kind == ShapeKind::Pieces)];
                let all = shapes.distances(&q).unwrap();
                count[0] += check(&shapes, &q, &all, &moves);
                let all = around.distances(&q).unwrap();
                count[1] += check(&around, &q, &all, &vec![true; all.len()]);
            }
        }
    }
    let is_some = |count: &usize| *count > 50 && *count < 4950;
    assert!(contacts.as_flattened().iter().all(is_some), "{contacts:?}");
}

/// Whether the robot is in contact; `all` are the distances of all pairs, `moves` says which count for a margin.
fn check(of: &impl Queries, q: &[f64], all: &[f64], moves: &[bool]) -> usize {
    let touches = all.contains(&0.0);
    assert_eq!(of.in_collision(q), Ok(touches), "{q:?}");
    let least = all.iter().copied().reduce(f64::min);
    assert_eq!(of.min_distance(q), Ok(least), "{q:?}");
    for margin in [0.003, 0.03, 0.3] {
        let near = all.iter().zip(moves).any(|(apart, moves)| *moves && *apart <= margin);
        assert_eq!(of.is_within(q, margin), Ok(near), "{margin} {q:?}");
    }
    usize::from(touches)
}
