//! Objects that links carry, and obstacles that move. Beside closed forms, and each beside the other.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use urdd_robot::{EdgeSettings, Obstacle, Proximity, Queries, Robot, RobotError, ShapeKind, World};

use super::planning::{SLIDE, robot_of};
use testkit::robots::made_of;

fn ball(name: &str, x: f64) -> Obstacle {
    Obstacle::sphere(name, [x, 0.0, 0.0], 0.05).expect("a sphere")
}

fn sliding() -> (tempfile::TempDir, Robot, Proximity) {
    let (folder, path) = made_of(SLIDE);
    let robot = Robot::open(path).expect("a robot");
    let all = robot.proximity_of(ShapeKind::Hulls, |_| true);
    (folder, robot, all.expect("shapes"))
}

/// The box ends 0.8 m from the base at `x` 0; the ball in front of it, toward the base, is 0.25 m nearer.
#[test]
fn a_ball_that_a_sliding_box_carries() {
    let (_folder, robot, alone) = sliding();
    let [base, link] = ["base", "box"].map(|name| robot.link(name).expect(name));
    let with = alone.attach(link, &ball("ball", -0.3)).expect("attached");
    assert_eq!([alone.num_pairs(), with.num_pairs()], [1, 2]);
    let near = with.nearest(&[0.5], 2).expect("pairs");
    assert_eq!([&*near[0].links[0], &*near[0].links[1]], ["base", "ball"]);
    assert_eq!(near[0].link_idxs, [base, link]);
    for (found, expected) in near.iter().zip([1.05, 1.3]) {
        assert!((found.distance - expected).abs() < 1e-6, "{found:?}");
    }
    assert!((near[0].points[1][0] - 0.15).abs() < 1e-6, "{near:?}");
    let gradient = &with.gradients(&[0.5], 1).expect("gradients")[0].gradient;
    assert!((gradient.as_ref().expect("apart")[0] - 1.0).abs() < 1e-9);
    for (x, [expected, without]) in [(-0.54, [false, false]), (-0.56, [true, false])] {
        assert_eq!(with.in_collision(&[x]), Ok(expected), "{x}");
        assert_eq!(alone.in_collision(&[x]), Ok(without), "{x}");
        assert_eq!(with.collisions(&[x]).expect("pairs").len(), usize::from(expected));
    }
    assert_eq!(with.is_within(&[0.0], 0.54), Ok(false));
    assert_eq!(with.is_within(&[0.0], 0.56), Ok(true));
    // From x = 1 to x = -1 the ball touches at x = -0.55.
    let proved = EdgeSettings { margin: 0.0, resolution: None, ..Default::default() };
    let part = with.blocked_edge(&[1.0], &[-1.0], &proved);
    let part = part.expect("an answer").expect("blocked");
    assert!(part <= 0.775 && (part - 0.775).abs() < 1e-3, "{part}");

    let may_touch = ball("ball", -0.3).ignoring("base");
    let with = alone.attach(link, &may_touch).expect("attached");
    assert_eq!(with.in_collision(&[-0.56]), Ok(false));
    assert_eq!(with.num_pairs(), 1);
}

/// The boxes overlap by 0.15 m, the ball and the base by 0.2 m.
#[test]
fn penetrations_of_a_sliding_box() {
    let (_folder, robot, alone) = sliding();
    let link = robot.link("box").expect("box");
    let with = alone.attach(link, &ball("ball", -0.1)).expect("attached");
    let found = with.penetrations(&[-0.95]).expect("an answer");
    assert_eq!(found.len(), 2);
    for (overlap, [name, depth]) in found.iter().zip([["box", "0.15"], ["ball", "0.15"]]) {
        assert_eq!(&*overlap.pair.links[1], name);
        let depth: f64 = depth.parse().expect("a number");
        assert!((overlap.depth - depth).abs() < 1e-6 || name == "ball", "{overlap:?}");
        assert_eq!(overlap.pair.distance, 0.0);
    }
    let of_box = &found[0];
    assert!((Vector3::from(of_box.direction) - Vector3::x()).norm() < 1e-9);
    assert!((of_box.gradient[0] + 1.0).abs() < 1e-9, "{of_box:?}");
    // The ball's centre is 0.05 m inside the base: out through the side in front.
    let of_ball = &with.penetrations(&[-0.85]).expect("an answer")[1];
    assert!((of_ball.depth - 0.1).abs() < 1e-6, "{of_ball:?}");
    assert!((of_ball.gradient[0] + 1.0).abs() < 1e-9, "{of_ball:?}");
    // The ball touches by its surface: its centre is 0.02 m outside.
    let of_ball = &with.penetrations(&[-0.78]).expect("an answer")[0];
    assert!(
        &*of_ball.pair.links[1] == "ball" && (of_ball.depth - 0.03).abs() < 1e-6,
        "{of_ball:?}"
    );
    assert!(with.penetrations(&[0.0]).expect("an answer").is_empty());

    let post = Obstacle::sphere("post", [1.0, 0.0, 0.0], 0.5).expect("a sphere");
    let world = alone.world_proximity(&World::new([post])).expect("a world");
    let found = world.penetrations(&[0.42]).expect("an answer");
    assert_eq!(found.len(), 1);
    assert!((found[0].depth - 0.02).abs() < 1e-6, "{found:?}");
    assert!((found[0].gradient[0] - 1.0).abs() < 1e-9, "{found:?}");
    assert!((found[0].direction[0] - 1.0).abs() < 1e-9);
}

/// The answers are those of `collisions`, and a small step along the gradient lowers the depth as it says.
#[test]
fn gradients_of_depths_are_differences() {
    let (_folder, robot) = robot_of("six_axis_arm");
    let proximity = robot.proximity(ShapeKind::Pieces).expect("shapes");
    let space = robot.configurations().expect("bounds");
    let mut compared = 0;
    for k in 0..200 {
        let q = space.random(k);
        let found = proximity.penetrations(&q).expect("an answer");
        let pairs = proximity.collisions(&q).expect("pairs");
        assert_eq!(found.len(), pairs.len(), "{k}");
        for overlap in found {
            let step = 1e-6;
            let depth = |by: f64, dof: usize| {
                let mut moved = q.clone();
                moved[dof] += by;
                let all = proximity.penetrations(&moved).expect("an answer");
                let same = |one: &&urdd_robot::Overlap<urdd_robot::PairDistance>| {
                    one.pair.link_idxs == overlap.pair.link_idxs
                        && one.pair.pieces == overlap.pair.pieces
                };
                all.iter().find(same).map(|one| one.depth)
            };
            for (dof, expected) in overlap.gradient.iter().enumerate() {
                let (Some(more), Some(less)) = (depth(step, dof), depth(-step, dof)) else {
                    continue;
                };
                let sides = [(more - overlap.depth) / step, (overlap.depth - less) / step];
                // Not where the depth is that of two translations.
                if (sides[0] - sides[1]).abs() < 1e-4 {
                    assert!((sides[0] - expected).abs() < 1e-3, "{k} {dof} {sides:?} {expected}");
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 300, "{compared}");
}

#[test]
fn obstacles_see_what_is_carried() {
    let (_folder, robot, alone) = sliding();
    let link = robot.link("box").expect("box");
    let with = alone.attach(link, &ball("ball", 0.3)).expect("attached");
    let post = Obstacle::sphere("post", [2.0, 0.0, 0.0], 0.5).expect("a sphere");
    let nearest = |with: &Proximity, post: Obstacle| {
        let world = with.world_proximity(&World::new([post])).expect("a world");
        let found = world.nearest(&[0.0], 1).expect("pairs");
        found.first().map(|found| (found.link.to_string(), found.distance))
    };
    let (name, distance) = nearest(&with, post.clone()).expect("a pair");
    assert!(name == "ball" && (distance - 1.15).abs() < 1e-9, "{distance}");
    // Who ignores the link does not ignore what it carries.
    let ignoring = post.clone().ignoring("box").ignoring("base");
    assert_eq!(nearest(&with, ignoring.clone()).expect("a pair").0, "ball");
    assert_eq!(nearest(&with, ignoring.ignoring("ball")), None);
    let (name, distance) = nearest(&with, post.clone().ignoring("ball")).expect("a pair");
    assert!(name == "box" && (distance - 1.4).abs() < 1e-6, "{distance}");
    // One metre that the box slides toward the post is one metre less.
    let world = with.world_proximity(&World::new([post.ignoring("base")])).expect("a world");
    for found in world.gradients(&[0.0], 2).expect("gradients") {
        let gradient = found.gradient.expect("apart");
        assert!((gradient[0] + 1.0).abs() < 1e-9, "{gradient:?}");
    }
    assert_eq!(world.gradients(&[1.5], 1).expect("gradients")[0].gradient, None);
}

/// A plate that is fixed to the box, 0.05 m in front of it, toward the base.
#[test]
fn links_that_cannot_move_against_each_other_have_no_margin() {
    let (_folder, path) = made_of(&SLIDE.replace("</robot>", &plate_text("-0.2")));
    let robot = Robot::open(path).expect("a robot");
    let all = robot.proximity_of(ShapeKind::Hulls, |_| true).expect("shapes");
    let least = all.self_distance(&[0.0]).expect("an answer").expect("pairs");
    assert!((least - 0.05).abs() < 1e-6, "the distance of the fixed pair: {least}");
    // The plate ends 0.65 m from the base at x = 0.
    assert_eq!([0.64, 0.66].map(|margin| all.is_within(&[0.0], margin)), [Ok(false), Ok(true)]);
    let proved = |margin: f64| EdgeSettings { margin, resolution: None, ..Default::default() };
    assert_eq!(all.blocked_edge(&[0.0], &[3.0], &proved(0.6)), Ok(None));
    assert_eq!(all.blocked_edge(&[0.0], &[3.0], &proved(0.7)), Ok(Some(0.0)));
    // What the plate carries need not name the box, which it reaches into.
    let plate = robot.link("plate").expect("plate");
    let with = all.attach(plate, &ball("ball", 0.05)).expect("attached");
    assert_eq!(with.in_collision(&[0.0]), Ok(false));
    assert_eq!(with.num_pairs(), all.num_pairs() + 1);
    // A margin of 0 is whether they touch, for every pair.
    let touching = SLIDE.replace("</robot>", &plate_text("-0.14"));
    let (_folder, path) = made_of(&touching);
    let robot = Robot::open(path).expect("a robot");
    let all = robot.proximity_of(ShapeKind::Hulls, |_| true).expect("shapes");
    assert_eq!(all.in_collision(&[0.0]), Ok(true));
    assert_eq!(all.is_within(&[0.0], 0.0), Ok(true));
    assert_eq!(all.blocked_edge(&[0.0], &[3.0], &proved(0.0)), Ok(Some(0.0)));
}

fn plate_text(x: &str) -> String {
    format!(
        r#"<link name="plate"><visual><geometry><box size="0.1 0.2 0.2"/></geometry></visual></link>
        <joint name="hold" type="fixed"><parent link="box"/><child link="plate"/><origin xyz="{x} 0 0"/></joint></robot>"#
    )
}

#[test]
fn what_two_links_carry_may_collide() {
    let (_folder, robot, alone) = sliding();
    let [base, link] = ["base", "box"].map(|name| robot.link(name).expect(name));
    let one = alone.attach(base, &ball("one", -0.5)).expect("attached");
    let two = one.attach(link, &ball("two", -0.2)).expect("attached");
    // Base and box; each ball and the other link; the two balls.
    assert_eq!(two.num_pairs(), 4);
    let touching = two.collisions(&[-0.25]).expect("pairs");
    assert_eq!(touching.len(), 1);
    assert_eq!(touching[0].links.each_ref().map(|name| &**name), ["one", "two"]);
    let same = one.attach(base, &ball("two", -0.5)).expect("attached");
    assert_eq!(same.num_pairs(), 3, "what one link carries does not move against itself");
    let apart = one.attach(link, &ball("two", -0.2).ignoring("one"));
    assert_eq!(apart.expect("attached").num_pairs(), 3);
}

#[test]
fn what_cannot_be_carried() {
    let (_folder, _, alone) = sliding();
    let out_of_range = alone.attach(7, &ball("ball", 0.0)).map(|_| ());
    assert!(matches!(out_of_range, Err(RobotError::OutOfRange { index: 7, count: 2, .. })));
    let unknown = alone.attach(0, &ball("ball", 0.0).ignoring("bax")).map(|_| ());
    assert!(
        matches!(unknown, Err(RobotError::Unknown { nearest: Some(near), .. }) if near == "box")
    );
    let taken = alone.attach(0, &ball("box", 0.0)).map(|_| ());
    assert!(matches!(taken, Err(RobotError::Obstacle { name, .. }) if name == "box"));
    let twice = alone.attach(0, &ball("ball", 0.0)).expect("attached");
    assert!(twice.attach(1, &ball("ball", 0.0)).is_err());
    let lost = Isometry3::translation(f64::NAN, 0.0, 0.0);
    assert!(matches!(ball("ball", 0.0).at(lost), Err(RobotError::Obstacle { .. })));
}

/// What a link carries is as far from another link as an obstacle that is moved along.
#[test]
fn carried_is_moved_along() {
    let (_folder, robot) = robot_of("welding_arm");
    let torch = robot.link("torch").expect("torch");
    let in_torch = Isometry3::from_parts(
        Translation3::new(0.05, -0.02, 0.1),
        UnitQuaternion::from_scaled_axis(Vector3::new(0.3, 0.4, -0.2)),
    );
    let of_sphere = Isometry3::translation(0.0, 0.0, 0.1);
    let objects = [
        (Obstacle::cuboid("carried", in_torch, [0.05, 0.1, 0.02]), in_torch),
        (Obstacle::sphere("carried", [0.0, 0.0, 0.1], 0.06), of_sphere),
        (Obstacle::capsule("carried", in_torch, 0.03, 0.2), in_torch),
        (Obstacle::cylinder("carried", in_torch, 0.05, 0.1), in_torch),
    ];
    let space = robot.configurations().expect("bounds");
    for (object, local) in objects {
        let object = object.expect("an object");
        for kind in ShapeKind::ALL {
            let proximity = robot.proximity(kind).expect("shapes");
            let with = proximity.attach(torch, &object).expect("attached");
            let mut world = World::default();
            for q in (0..20).map(|k| space.random(k)) {
                let pose = robot.link_poses(&q).expect("poses")[torch];
                world.put(object.clone().ignoring("torch").at(pose * local).expect("moved"));
                assert_eq!(world.obstacles().len(), 1);
                let around = proximity.world_proximity(&world).expect("a world");
                let expected = around.min_distance(&q).expect("a distance").expect("pairs");
                let of_object = with.closest_points(&q).expect("pairs").into_iter();
                let of_object = of_object
                    .filter(|pair| &*pair.links[1] == "carried" || &*pair.links[0] == "carried");
                let least = of_object.map(|pair| pair.distance).fold(f64::INFINITY, f64::min);
                assert!((least - expected).abs() < 2e-9, "{kind:?} {least} {expected}");
                let alone = proximity.in_collision(&q).expect("an answer");
                assert_eq!(with.in_collision(&q), Ok(alone || expected == 0.0));
            }
            assert!(world.remove("carried").is_some() && world.remove("carried").is_none());
        }
    }
}

/// Answers tell an object from its link, and another object on it; what is left out is not answered.
#[test]
fn bodies_and_pairs_that_are_left_out() {
    let (_folder, robot, alone) = sliding();
    let links = robot.link_names().expect("links").len();
    let [base, link] = ["base", "box"].map(|name| robot.link(name).expect(name));
    let with = alone.attach(link, &ball("near", -0.3)).expect("attached");
    let with = with.attach(link, &ball("far", 0.3)).expect("attached");
    assert_eq!(with.num_bodies(), links + 2);
    let names = |proximity: &Proximity| -> Vec<String> {
        let near = proximity.nearest(&[0.5], 9).expect("pairs");
        for (one, gradient) in near.iter().zip(proximity.gradients(&[0.5], 9).expect("pairs")) {
            assert_eq!(*one, gradient.pair);
            assert_eq!(
                one.body_idxs.map(|body| proximity.body_name(body)),
                one.links.each_ref().map(|name| Some(&**name))
            );
            assert_eq!(one.link_idxs, [base, link]);
        }
        let bodies: Vec<[usize; 2]> = near.iter().map(|one| one.body_idxs).collect();
        let mut all: Vec<[usize; 2]> = proximity.pair_bodies().collect();
        assert_eq!(bodies.len(), all.len());
        all.retain(|pair| !bodies.contains(pair));
        assert!(all.is_empty());
        near.iter().map(|one| one.links[1].to_string()).collect()
    };
    assert_eq!(names(&with), ["near", "box", "far"]);
    let left = with.without([["near", "base"]]).expect("known names");
    assert_eq!(names(&left), ["box", "far"]);
    assert_eq!(
        names(&left.without([["base", "box"], ["far", "far"]]).expect("known names")),
        ["far"]
    );
    // Without the base nothing is left; without an object, the other keeps its index.
    assert_eq!(with.without_bodies(["base"]).expect("known names").num_pairs(), 0);
    let far = with.without_bodies(["near", "box"]).expect("known names");
    assert_eq!((names(&far), far.body("far")), (vec!["far".to_owned()], Ok(links + 1)));
    assert_eq!([far.num_shapes(), with.num_shapes()], [2, 4]);
    // The closest points of what is left are where they were.
    assert_eq!(far.nearest(&[0.5], 1), with.nearest(&[0.5], 3).map(|all| all[2..].to_vec()));
    for wrong in [with.without([["base", "ner"]]), with.without_bodies(["ner"])] {
        let Err(RobotError::Unknown { name, nearest, .. }) = wrong else { panic!("{wrong:?}") };
        assert_eq!((&*name, nearest.as_deref()), ("ner", Some("near")));
    }
    // Obstacles see all that `without` leaves, and nothing of a body that is left out.
    let post = World::new([Obstacle::sphere("post", [2.0, 0.0, 0.0], 0.5).expect("a sphere")]);
    let seen = |shapes: &Proximity| -> Vec<usize> {
        let world = shapes.world_proximity(&post).expect("a world");
        let near = world.nearest(&[0.0], 9).expect("pairs");
        assert_eq!(world.pair_bodies().count(), near.len());
        near.iter().map(|one| one.body_idx).collect()
    };
    assert_eq!(seen(&left), [links + 1, link, links, base]);
    assert_eq!(seen(&far), [links + 1, base]);
}
