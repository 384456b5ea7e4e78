//! Motions, obstacles that move, bodies that are left out, arrays that overlap.

use std::ptr::{null, null_mut};

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use urdd_c::*;
use urdd_robot::{EdgeSettings, Obstacle as Body, Queries, ShapeKind, World};

use crate::interface::{arm, c, fails, ok, open, proximity, samples, text};

/// A pose as C has it.
fn matrix(k: usize) -> [f64; 16] {
    let x = k as f64;
    let turn = UnitQuaternion::from_euler_angles(x, 0.4 * x, 2.0 * x);
    let pose = Isometry3::from_parts(Translation3::new(0.5 - 0.1 * x, 0.1 * x, 0.4), turn);
    let mut matrix = [0.0; 16];
    urdd_kinematics::pose::write_matrix(&pose, &mut matrix);
    matrix
}

/// What C makes of it.
fn pose(k: usize) -> Isometry3<f64> {
    urdd_kinematics::pose::pose(&matrix(k)).expect("a pose")
}

/// The arm, a ball on its torch, and boxes, through C and in Rust.
struct Scene {
    shapes: *mut Proximity,
    world: *mut WorldProximity,
    known: urdd_robot::Proximity,
    boxes: World,
}

const BOXES: usize = 5;

fn scene() -> Scene {
    let (robot, handle) = (arm(), open());
    let torch = robot.link("torch").expect("torch");
    let ball = Body::sphere("ball", [0.0, 0.0, 0.1], 0.05).expect("a sphere");
    let known = robot.proximity(ShapeKind::Pieces).expect("shapes");
    let known = known.attach(torch, &ball).expect("attached");
    let half = [0.15, 0.12, 0.1];
    let boxes = (0..BOXES).map(|k| Body::cuboid("box", pose(k), half).expect("a box"));
    let boxes = World::new(boxes);
    // SAFETY: as the header says.
    unsafe {
        let alone = proximity(handle, "pieces");
        let (mut ball, mut shapes, mut world) = (null_mut(), null_mut(), null_mut());
        let centre = [0.0, 0.0, 0.1];
        ok(urdd_obstacle_sphere(c"ball".as_ptr(), centre.as_ptr(), 0.05, &mut ball));
        ok(urdd_proximity_attach(alone, torch, ball, &mut shapes));
        let made = (0..BOXES).map(|k| {
            let (mut made, at) = (null_mut(), matrix(k));
            ok(urdd_obstacle_cuboid(c"box".as_ptr(), at.as_ptr(), half.as_ptr(), &mut made));
            made.cast_const()
        });
        let made: Vec<*const Obstacle> = made.collect();
        ok(urdd_proximity_world_proximity(shapes, made.as_ptr(), BOXES, &mut world));
        for one in made {
            ok(urdd_obstacle_free(one.cast_mut()));
        }
        ok(urdd_obstacle_free(ball));
        ok(urdd_proximity_free(alone));
        ok(urdd_robot_free(handle));
        Scene { shapes, world, known, boxes }
    }
}

impl Drop for Scene {
    fn drop(&mut self) {
        // SAFETY: they are open.
        unsafe {
            ok(urdd_proximity_free(self.shapes));
            ok(urdd_world_proximity_free(self.world));
        }
    }
}

#[test]
fn questions_about_obstacles_are_those_of_rust() {
    let scene = scene();
    let around = scene.known.world_proximity(&scene.boxes).expect("a world");
    let (q, dofs) = (samples(40), 6);
    // SAFETY: as the header says.
    unsafe {
        let [mut pairs, mut of_parts, mut found] = [0; 3];
        ok(urdd_world_proximity_sizes(scene.world, &mut pairs, &mut of_parts, null_mut()));
        assert_eq!([pairs, of_parts], [around.num_pairs(), around.num_pairs_of_parts()]);
        let mut each = vec![ObstaclePair { link: 9, body: 9, piece: 9, obstacle: 9 }; pairs];
        ok(urdd_world_proximity_pairs(scene.world, each.as_mut_ptr(), pairs));
        for (one, known) in each.iter().zip(around.pairs().zip(around.pair_bodies())) {
            let (([link, piece], obstacle), body) = known;
            assert_eq!(
                [one.link, one.body, one.piece, one.obstacle],
                [link, body, piece, obstacle]
            );
        }
        assert!(each.iter().any(|one| one.body == 9 && one.link != 9));
        let mut distances = vec![0.0; 40 * pairs];
        let (at, length) = (distances.as_mut_ptr(), distances.len());
        ok(urdd_world_proximity_distances(scene.world, q.as_ptr(), 40, dofs, at, length));
        let mut overlapping = 0;
        for (row, distances) in q.chunks(dofs).zip(distances.chunks(pairs)) {
            assert_eq!(*distances, *around.distances(row).expect("distances"));
            let expected = around.penetrations(row).expect("overlaps");
            let pair = ObstacleDistance::from(around.nearest(row, 1).expect("pairs").remove(0));
            let mut overlaps = [ObstacleOverlap { pair, depth: 0.0, direction: [0.0; 3] }; 9];
            let (out, at) = (overlaps.as_mut_ptr(), row.as_ptr());
            ok(urdd_world_proximity_penetrations(scene.world, at, dofs, out, 9, &mut found));
            assert_eq!(found, expected.len());
            for (one, known) in overlaps.iter().zip(&expected) {
                assert_eq!((one.depth, one.direction), (known.depth, known.direction));
                assert_eq!(one.pair.points, known.pair.points);
                assert_eq!(
                    (one.pair.body, one.pair.obstacle),
                    (known.pair.body_idx, known.pair.obstacle_idx)
                );
            }
            overlapping += found;
        }
        assert!(overlapping > 5, "{overlapping}");
    }
}

#[test]
fn obstacles_that_are_moved_are_those_of_rust() {
    let scene = scene();
    let mut around = scene.known.world_proximity(&scene.boxes).expect("a world");
    let q = samples(20);
    // SAFETY: as the header says.
    unsafe {
        let mut answers = [0.0; 20];
        for cycle in 1..10 {
            let places = [0, 1, 2].map(|k| cycle + 2 * k);
            let at = places.map(matrix);
            ok(urdd_world_proximity_move_obstacles(scene.world, 1, at.as_flattened().as_ptr(), 3));
            around.move_obstacles(1, &places.map(pose)).expect("moved");
            let out = answers.as_mut_ptr();
            ok(urdd_world_proximity_min_distance(scene.world, q.as_ptr(), 20, 6, out));
            for (row, answer) in q.chunks(6).zip(answers) {
                assert_eq!(around.min_distance(row), Ok(Some(answer)));
            }
        }
        let mut at = [matrix(1), matrix(2)].concat();
        at[19] = f64::NAN;
        let moved = |first, count| {
            urdd_world_proximity_move_obstacles(scene.world, first, at.as_ptr(), count)
        };
        fails(moved(0, 2), Status::Value, "not a rotation and a translation");
        fails(moved(BOXES, 1), Status::OutOfRange, "obstacle 5");
        fails(moved(0, usize::MAX), Status::Length, "more than any memory");
        let before = answers;
        ok(urdd_world_proximity_min_distance(scene.world, q.as_ptr(), 20, 6, answers.as_mut_ptr()));
        assert_eq!(before, answers);
    }
}

#[test]
fn first_contacts_and_motions_without_end() {
    let scene = scene();
    let around = scene.known.world_proximity(&scene.boxes).expect("a world");
    let q = samples(40);
    let (starts, ends) = q.split_at(20 * 6);
    // SAFETY: as the header says.
    unsafe {
        for resolution in [0.02, 0.0] {
            let mut contacts = [[[0.0; 2]; 20]; 2];
            let (from, to) = (starts.as_ptr(), ends.as_ptr());
            let [own, others] = contacts.each_mut().map(|one| one.as_flattened_mut().as_mut_ptr());
            ok(urdd_proximity_first_contact(
                scene.shapes,
                from,
                to,
                20,
                6,
                0.0,
                resolution,
                own,
                40,
            ));
            ok(urdd_world_proximity_first_contact(
                scene.world,
                from,
                to,
                20,
                6,
                0.0,
                resolution,
                others,
                40,
            ));
            let settings = EdgeSettings {
                margin: 0.0,
                resolution: (resolution > 0.0).then_some(resolution),
                ..Default::default()
            };
            let mut blocked = 0;
            for (k, (start, end)) in starts.chunks(6).zip(ends.chunks(6)).enumerate() {
                let expected = [
                    scene.known.first_contact(start, end, &settings).expect("an answer"),
                    around.first_contact(start, end, &settings).expect("an answer"),
                ];
                for (found, expected) in contacts.iter().zip(expected) {
                    match expected {
                        None => assert!(found[k].iter().all(|part| part.is_nan())),
                        Some(contact) => assert_eq!(found[k], [contact.free, contact.blocked]),
                    }
                    blocked += usize::from(expected.is_some());
                }
            }
            assert!(blocked > 5 && blocked < 40, "{blocked}");
        }
        let (start, mut end, mut part) = ([0.0; 6], [0.0; 6], [0.0; 2]);
        for length in [1e7, f64::MAX] {
            end[0] = length;
            let (from, to) = (start.as_ptr(), end.as_ptr());
            let out = part.as_mut_ptr();
            for resolution in [0.0, 0.01] {
                // An obstacle that is near ends a motion.
                let near = urdd_world_proximity_blocked_edge(
                    scene.world,
                    from,
                    to,
                    1,
                    6,
                    0.0,
                    resolution,
                    out,
                );
                assert!(matches!(near, Status::Ok | Status::Value));
                let blocked =
                    urdd_proximity_blocked_edge(scene.shapes, from, to, 1, 6, 0.0, resolution, out);
                fails(blocked, Status::Value, "steps: divide it");
                let first = urdd_proximity_first_contact(
                    scene.shapes,
                    from,
                    to,
                    1,
                    6,
                    0.0,
                    resolution,
                    out,
                    2,
                );
                fails(first, Status::Value, "steps: divide it");
            }
        }
    }
}

#[test]
fn bodies_and_what_is_left_out() {
    let scene = scene();
    // SAFETY: as the header says.
    unsafe {
        let (mut count, mut body, mut name) = (0, 0, urdd_version());
        ok(urdd_proximity_num_bodies(scene.shapes, &mut count));
        assert_eq!(count, 10);
        for index in 0..count {
            ok(urdd_proximity_body_name(scene.shapes, index, &mut name));
            assert_eq!(Some(&*text(name)), scene.known.body_name(index));
            ok(urdd_proximity_body(scene.shapes, name.data, &mut body));
            assert_eq!(body, index);
        }
        fails(urdd_proximity_body_name(scene.shapes, 10, &mut name), Status::OutOfRange, "body 10");
        let unknown = urdd_proximity_body(scene.shapes, c"bal".as_ptr(), &mut body);
        fails(unknown, Status::UnknownName, "`ball`");
        let names = scene.known.pair_names().next().expect("a pair").map(c);
        let texts = [names[0].as_ptr(), names[1].as_ptr()];
        let of = |shapes: *const Proximity| {
            let mut pairs = 0;
            ok(urdd_proximity_sizes(shapes, null_mut(), &mut pairs, null_mut()));
            pairs
        };
        let mut without = null_mut();
        ok(urdd_proximity_without(scene.shapes, texts.as_ptr(), 1, &mut without));
        let both = [names[0].to_str().expect("UTF-8"), names[1].to_str().expect("UTF-8")];
        let known = scene.known.without([both]).expect("known names");
        assert_eq!(of(without), known.num_pairs());
        assert!(of(without) < of(scene.shapes));
        ok(urdd_proximity_free(without));
        ok(urdd_proximity_without_bodies(scene.shapes, texts.as_ptr(), 2, &mut without));
        let known = scene.known.without_bodies(both).expect("known names");
        assert_eq!(of(without), known.num_pairs());
        ok(urdd_proximity_free(without));
        let wrong = [texts[0], c"bal".as_ptr()];
        let unknown = urdd_proximity_without(scene.shapes, wrong.as_ptr(), 1, &mut without);
        fails(unknown, Status::UnknownName, "`ball`");
        assert!(without.is_null());
        let missing = [texts[0], null()];
        let missing =
            urdd_proximity_without_bodies(scene.shapes, missing.as_ptr(), 2, &mut without);
        fails(missing, Status::Pointer, "`a name` is null");
        let too_many =
            urdd_proximity_without(scene.shapes, texts.as_ptr(), usize::MAX, &mut without);
        fails(too_many, Status::Length, "more than any memory");
    }
}

/// Every array that is written, over each other argument of its call.
#[test]
fn arrays_that_overlap_are_refused() {
    let scene = scene();
    let mut memory = vec![0.0; 4096];
    let at = memory.as_mut_ptr();
    // SAFETY: there is room for all of it wherever two begin.
    unsafe {
        let place = |shared: bool, k: usize| at.add(if shared { 0 } else { 512 * k });
        let overlaps = |ask: &dyn Fn([*mut f64; 3]) -> Status, arrays: usize| {
            ok(ask([0, 1, 2].map(|k| place(false, k + 1))));
            for a in 0..arrays {
                for b in 0..a {
                    let status = ask([0, 1, 2].map(|k| place(k == a || k == b, k + 1)));
                    fails(status, Status::Pointer, "overlap");
                    // From its second value on.
                    let status = ask([0, 1, 2].map(|k| match k {
                        k if k == a => at.add(1),
                        k => place(k == b, k + 1),
                    }));
                    fails(status, Status::Pointer, "overlap");
                }
            }
        };
        let (q, dofs) = ([0.1; 6], 6);
        let q = q.as_ptr();
        overlaps(
            &|[near, gradients, found]| {
                urdd_proximity_gradients(
                    scene.shapes,
                    q,
                    dofs,
                    3,
                    near.cast(),
                    gradients,
                    found.cast(),
                )
            },
            3,
        );
        overlaps(
            &|[near, gradients, found]| {
                urdd_world_proximity_gradients(
                    scene.world,
                    q,
                    dofs,
                    3,
                    near.cast(),
                    gradients,
                    found.cast(),
                )
            },
            3,
        );
        overlaps(
            &|[near, q, found]| {
                urdd_proximity_nearest(scene.shapes, q, 1, dofs, 3, near.cast(), found.cast())
            },
            3,
        );
        overlaps(
            &|[near, q, found]| {
                urdd_world_proximity_nearest(scene.world, q, 1, dofs, 3, near.cast(), found.cast())
            },
            3,
        );
        overlaps(
            &|[all, q, found]| {
                urdd_proximity_penetrations(scene.shapes, q, dofs, all.cast(), 2, found.cast())
            },
            3,
        );
        overlaps(
            &|[all, q, found]| {
                urdd_world_proximity_penetrations(scene.world, q, dofs, all.cast(), 2, found.cast())
            },
            3,
        );
        overlaps(
            &|[starts, blocked, _]| {
                urdd_proximity_blocked_edge(scene.shapes, starts, q, 1, dofs, 0.0, 0.1, blocked)
            },
            2,
        );
        overlaps(
            &|[ends, contacts, _]| {
                urdd_world_proximity_first_contact(
                    scene.world,
                    q,
                    ends,
                    1,
                    dofs,
                    0.0,
                    0.1,
                    contacts,
                    2,
                )
            },
            2,
        );
        let pairs = scene.known.num_pairs();
        overlaps(
            &|[q, distances, _]| {
                urdd_proximity_distances(scene.shapes, q, 1, dofs, distances, pairs)
            },
            2,
        );
        let (one, other) = (at.cast(), at.add(8).cast());
        ok(urdd_proximity_sizes(scene.shapes, one, other, null_mut()));
        let same = urdd_proximity_sizes(scene.shapes, one, other, one);
        fails(same, Status::Pointer, "`shapes` and `dofs` overlap");
        // What is only read may be the same.
        let mut part = [0.0; 1];
        ok(urdd_proximity_blocked_edge(scene.shapes, q, q, 1, dofs, 0.0, 0.1, part.as_mut_ptr()));
    }
}
