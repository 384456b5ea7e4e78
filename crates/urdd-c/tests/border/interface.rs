//! The C interface gives what the Rust interface gives, to the bit, and an error for what a caller does wrong.

use std::ffi::{CString, c_char};
use std::path::PathBuf;
use std::ptr::{null, null_mut};
use std::sync::LazyLock;

use nalgebra::{Isometry3, Vector3};
use urdd_c::*;
use urdd_robot::{EdgeSettings, Queries, ShapeKind, World};

/// A URDD of the welding arm, with every module, for all tests.
static ARM: LazyLock<(tempfile::TempDir, PathBuf)> = LazyLock::new(|| {
    testkit::robots::made(&testkit::repository().join("conformance/robots/welding_arm.urdf"))
});

pub fn c(text: &str) -> CString {
    CString::new(text).expect("no zero byte")
}

pub fn said() -> String {
    text(urdd_error_message())
}

pub fn text(text: Text) -> String {
    // SAFETY: a text of the library.
    let bytes = unsafe { std::slice::from_raw_parts(text.data.cast::<u8>(), text.length) };
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

pub fn ok(status: Status) {
    assert_eq!(status, Status::Ok, "{}", said());
}

/// Holds a call to its status, and to words of its message.
#[track_caller]
pub fn fails(status: Status, expected: Status, words: &str) {
    assert_eq!(status, expected, "{}", said());
    assert!(said().contains(words), "{}", said());
}

pub fn arm_path() -> CString {
    c(ARM.1.to_str().expect("UTF-8"))
}

pub fn open() -> *mut Robot {
    let (path, mut robot) = (arm_path(), null_mut());
    // SAFETY: as the header says.
    ok(unsafe { urdd_robot_open(path.as_ptr(), &mut robot) });
    robot
}

pub fn proximity(robot: *const Robot, kind: &str) -> *mut Proximity {
    let (kind, mut made) = (c(kind), null_mut());
    // SAFETY: as the header says.
    ok(unsafe { urdd_robot_proximity(robot, kind.as_ptr(), &mut made) });
    made
}

pub fn arm() -> urdd_robot::Robot {
    urdd_robot::Robot::open(&ARM.1).expect("a robot")
}

/// Samples of the arm, one after another.
pub fn samples(count: u64) -> Vec<f64> {
    let robot = arm();
    let space = robot.configurations().expect("configurations");
    (0..count).flat_map(|k| space.random(k)).collect()
}

#[test]
fn names_sizes_and_configurations_are_those_of_rust() {
    let (handle, robot) = (open(), arm());
    let (mut links, mut joints, mut dofs) = (0, 0, 0);
    // SAFETY: as the header says.
    unsafe {
        ok(urdd_robot_sizes(handle, &mut links, &mut joints, &mut dofs));
        ok(urdd_robot_sizes(handle, null_mut(), null_mut(), null_mut()));
        assert_eq!((links, joints, dofs), (9, 8, 6));
        let mut name = urdd_version();
        for (k, known) in robot.link_names().unwrap().iter().enumerate() {
            ok(urdd_robot_link_name(handle, k, &mut name));
            assert_eq!(text(name), *known);
            let mut index = usize::MAX;
            ok(urdd_robot_link(handle, name.data, &mut index));
            assert_eq!(index, k);
        }
        for (k, known) in robot.dof_names().unwrap().iter().enumerate() {
            ok(urdd_robot_dof_name(handle, k, &mut name));
            assert_eq!(text(name), *known);
            ok(urdd_robot_dof_unit(handle, k, &mut name));
            assert_eq!(text(name), robot.dof_units().unwrap()[k]);
        }
        for (k, known) in robot.joint_names().unwrap().iter().enumerate() {
            let mut index = usize::MAX;
            ok(urdd_robot_joint(handle, c(known).as_ptr(), &mut index));
            assert_eq!(index, k);
        }
        let (mut between, mut found) = ([usize::MAX; 6], 0);
        let (from, to) = (robot.link("turret").unwrap(), robot.link("flange").unwrap());
        let length = between.len() - 1;
        ok(urdd_robot_dofs_between(handle, from, to, between.as_mut_ptr(), length, &mut found));
        let known = robot.dofs_between(from, to).unwrap();
        assert_eq!(between[..found], known);
        assert_eq!(between[5], usize::MAX);
        let far = urdd_robot_dofs_between(handle, 9, to, between.as_mut_ptr(), length, &mut found);
        assert_eq!(far, Status::OutOfRange);
        // Room for fewer than there are: their number is said.
        ok(urdd_robot_dofs_between(handle, from, to, between.as_mut_ptr(), 1, &mut found));
        assert_eq!((between[0], found), (known[0], known.len()));
        let mut bounds = [0.0; 12];
        ok(urdd_robot_bounds(handle, bounds.as_mut_ptr(), 12));
        let space = robot.configurations().unwrap();
        assert_eq!(bounds, *space.bounds().as_flattened());
        let mut q = [9.0; 6];
        ok(urdd_robot_clamp(handle, q.as_mut_ptr(), 6));
        assert_eq!(q, *space.upper());
        ok(urdd_robot_zero(handle, q.as_mut_ptr(), 6));
        assert_eq!(q, *space.zero());
        let mut many = [0.0; 18];
        ok(urdd_robot_random(handle, 0, many.as_mut_ptr(), 3, 6));
        assert_eq!(many, *samples(3));
        let mut named = usize::MAX;
        ok(urdd_robot_num_named_configurations(handle, &mut named));
        assert_eq!(named, robot.named_configurations().unwrap().len());
        ok(urdd_robot_free(handle));
    }
}

#[test]
fn poses_and_jacobians_are_those_of_rust_in_one_row_and_in_many() {
    let (handle, robot, q) = (open(), arm(), samples(100));
    let torch = robot.link("torch").unwrap();
    let (mut poses, mut one) = (vec![0.0; 100 * 9 * 16], vec![0.0; 9 * 16]);
    let (mut jacobians, point) = (vec![0.0; 100 * 36], [0.1, 0.2, 0.3]);
    // SAFETY: as the header says.
    unsafe {
        let (all, length) = (poses.as_mut_ptr(), poses.len());
        ok(urdd_robot_link_poses(handle, q.as_ptr(), 100, 6, all, length));
        for k in 0..100 {
            let row = &q[6 * k..6 * k + 6];
            ok(urdd_robot_link_poses(handle, row.as_ptr(), 1, 6, one.as_mut_ptr(), 144));
            assert_eq!(one, poses[144 * k..144 * k + 144]);
            for (found, known) in one.chunks(16).zip(robot.link_poses(row).unwrap()) {
                assert_eq!(*found, *known.to_homogeneous().transpose().as_slice());
            }
        }
        let (all, length) = (jacobians.as_mut_ptr(), jacobians.len());
        ok(urdd_robot_jacobians(handle, q.as_ptr(), 100, 6, torch, point.as_ptr(), all, length));
        for (k, found) in jacobians.chunks(36).enumerate() {
            let row = &q[6 * k..6 * k + 6];
            let known = robot.jacobian_at(row, torch, point).unwrap();
            let far = found.iter().zip(&known).map(|(a, b)| (a - b).abs());
            assert!(far.fold(0.0, f64::max) < 1e-14);
        }
        ok(urdd_robot_free(handle));
    }
}

#[test]
fn distances_and_collisions_are_those_of_rust() {
    let (handle, robot, q) = (open(), arm(), samples(64));
    let known = robot.proximity(ShapeKind::Pieces).unwrap();
    let made = proximity(handle, "pieces");
    let pairs = known.num_pairs();
    // SAFETY: as the header says.
    unsafe {
        ok(urdd_robot_free(handle));
        let mut sizes = [0; 3];
        let [shapes, checked, dofs] = &mut sizes;
        ok(urdd_proximity_sizes(made, shapes, checked, dofs));
        assert_eq!(sizes, [known.num_shapes(), pairs, 6]);
        let mut distances = vec![0.0; 64 * pairs];
        let (at, length) = (distances.as_mut_ptr(), distances.len());
        ok(urdd_proximity_distances(made, q.as_ptr(), 64, 6, at, length));
        assert_eq!(distances, known.distances_batch(&q).unwrap());
        let (mut colliding, mut least) = ([false; 64], [0.0; 64]);
        ok(urdd_proximity_in_collision(made, q.as_ptr(), 64, 6, colliding.as_mut_ptr()));
        assert_eq!(colliding, *known.in_collision_batch(&q).unwrap());
        assert!(colliding.contains(&true) && colliding.contains(&false));
        ok(urdd_proximity_self_distance(made, q.as_ptr(), 64, 6, least.as_mut_ptr()));
        assert_eq!(least, *known.min_distance_batch(&q).unwrap());
        for (k, row) in q.chunks(6).enumerate().take(8) {
            let (mut one, mut d) = (false, f64::NAN);
            ok(urdd_proximity_in_collision(made, row.as_ptr(), 1, 6, &mut one));
            ok(urdd_proximity_self_distance(made, row.as_ptr(), 1, 6, &mut d));
            assert_eq!((one, d), (colliding[k], least[k]));
        }
        let empty = PairDistance::from(known.nearest(&q[..6], 1).unwrap().remove(0));
        let (mut near, mut found) = (vec![empty; 64 * 3], 0);
        ok(urdd_proximity_nearest(made, q.as_ptr(), 64, 6, 3, near.as_mut_ptr(), &mut found));
        assert_eq!(found, 3);
        let mut all = vec![empty; 64 * pairs];
        let (at, length) = (all.as_mut_ptr(), all.len());
        ok(urdd_proximity_closest_points(made, q.as_ptr(), 64, 6, at, length));
        for (k, row) in q.chunks(6).enumerate() {
            for (found, known) in near[3 * k..].iter().zip(known.nearest(row, 3).unwrap()) {
                assert_eq!(found.distance, known.distance);
                let Pair { links, bodies, pieces } = found.pair;
                assert_eq!((links, pieces), (known.link_idxs, known.pieces));
                assert_eq!(bodies, known.body_idxs);
                assert_eq!(found.points, known.points);
            }
            assert_eq!(all[pairs * k + 1].distance, distances[pairs * k + 1]);
        }
        ok(urdd_proximity_free(made));
    }
}

#[test]
fn obstacles_are_those_of_rust_and_outlive_their_handles() {
    let (handle, robot, q) = (open(), arm(), samples(64));
    let made = proximity(handle, "pieces");
    let matrix = [1., 0., 0., 0.4, 0., 1., 0., 0., 0., 0., 1., 0.3, 0., 0., 0., 1.];
    let (half, floor) = ([0.1, 0.2, 0.3], [5.0, 5.0, 0.05]);
    let below = [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., -0.05, 0., 0., 0., 1.];
    let base = c(&robot.link_names().unwrap()[0]);
    let known = {
        let at = nalgebra::Isometry3::translation;
        let a = urdd_robot::Obstacle::cuboid("a", at(0.4, 0.0, 0.3), half).unwrap();
        let b = urdd_robot::Obstacle::cuboid("b", at(0.0, 0.0, -0.05), floor).unwrap();
        World::new([a, b.ignoring(&robot.link_names().unwrap()[0])])
    };
    let rust = robot.proximity(ShapeKind::Pieces).unwrap();
    let rust = rust.world_proximity(&known).unwrap();
    // SAFETY: as the header says.
    unsafe {
        let [mut a, mut b, mut ignoring] = [null_mut(); 3];
        ok(urdd_obstacle_cuboid(c"a".as_ptr(), matrix.as_ptr(), half.as_ptr(), &mut a));
        ok(urdd_obstacle_cuboid(c"b".as_ptr(), below.as_ptr(), floor.as_ptr(), &mut b));
        ok(urdd_obstacle_ignoring(b, base.as_ptr(), &mut ignoring));
        let (both, mut world) = ([a.cast_const(), ignoring.cast_const()], null_mut());
        ok(urdd_proximity_world_proximity(made, both.as_ptr(), 2, &mut world));
        for obstacle in [a, b, ignoring] {
            ok(urdd_obstacle_free(obstacle));
        }
        ok(urdd_proximity_free(made));
        ok(urdd_robot_free(handle));
        let (mut colliding, mut least) = ([false; 64], [0.0; 64]);
        ok(urdd_world_proximity_in_collision(world, q.as_ptr(), 64, 6, colliding.as_mut_ptr()));
        ok(urdd_world_proximity_min_distance(world, q.as_ptr(), 64, 6, least.as_mut_ptr()));
        assert!(colliding.contains(&true) && colliding.contains(&false));
        for (k, row) in q.chunks(6).enumerate() {
            assert_eq!(colliding[k], rust.in_collision(row).unwrap());
            assert_eq!(Some(least[k]), rust.min_distance(row).unwrap());
        }
        let empty = ObstacleDistance {
            link: 0,
            body: 0,
            piece: 0,
            obstacle: 0,
            distance: 0.0,
            points: [[0.0; 3]; 2],
        };
        let (mut near, mut found) = ([empty; 2 * 64], 0);
        ok(urdd_world_proximity_nearest(
            world,
            q.as_ptr(),
            64,
            6,
            2,
            near.as_mut_ptr(),
            &mut found,
        ));
        assert_eq!(found, 2);
        assert_eq!(near.chunks(2).map(|both| both[0].distance).collect::<Vec<_>>(), least);
        ok(urdd_world_proximity_free(world));
    }
}

#[test]
fn archives_are_opened_and_validated() {
    let path = testkit::repository().join("examples/urdds/arm");
    let (path, mut report) = (c(path.to_str().unwrap()), null_mut());
    let (mut passes, mut json) = (false, urdd_version());
    // SAFETY: as the header says.
    unsafe {
        ok(urdd_validate(path.as_ptr(), null(), &mut report));
        ok(urdd_report_passes(report, &mut passes));
        ok(urdd_report_json(report, &mut json));
        let value: serde_json::Value = serde_json::from_str(&text(json)).unwrap();
        assert_eq!((passes, &value["urdds"][0]["verdict"]), (true, &"pass".into()));
        ok(urdd_report_free(report));
        let stale = testkit::repository().join("examples/urdds");
        ok(urdd_validate(c(stale.to_str().unwrap()).as_ptr(), null(), &mut report));
        ok(urdd_report_passes(report, &mut passes));
        assert!(!passes);
        ok(urdd_report_free(report));
        let wrong = c"sellect = 1";
        fails(urdd_validate(path.as_ptr(), wrong.as_ptr(), &mut report), Status::Value, "sellect");
        assert!(report.is_null());
        let (bytes, mut robot) = (b"PK\x05\x06", null_mut());
        let open = urdd_robot_of_archive(c"a.zip".as_ptr(), bytes.as_ptr(), 4, &mut robot);
        fails(open, Status::Open, "a.zip: ");
    }
}

#[test]
fn what_a_caller_does_wrong_is_a_status_with_a_text() {
    let (handle, q) = (open(), samples(2));
    let made = proximity(handle, "hulls");
    let mut poses = vec![0.0; 2 * 144];
    let room = poses.as_mut_ptr();
    // SAFETY: every mistake is one that the header says is found.
    unsafe {
        let ask = |q: *const f64, rows, dofs, room, length| {
            urdd_robot_link_poses(handle, q, rows, dofs, room, length)
        };
        let at = q.as_ptr();
        fails(
            urdd_robot_link_poses(null(), at, 1, 6, room, 144),
            Status::Pointer,
            "urdd_robot is null",
        );
        fails(ask(null(), 1, 6, room, 144), Status::Pointer, "`configurations` is null");
        fails(ask(at, 1, 6, null_mut(), 144), Status::Pointer, "`poses` is null");
        fails(ask(at, 1, 5, room, 144), Status::Length, "5 values in a row: expected 6");
        fails(ask(at, 2, 6, room, 144), Status::Length, "expected 2 x 144");
        fails(ask(at, usize::MAX / 4, 6, room, 144), Status::Length, "more than any memory");
        fails(ask(at, usize::MAX, 6, room, usize::MAX), Status::Length, "more than any memory");
        fails(ask(at.byte_add(1), 1, 6, room, 144), Status::Pointer, "not aligned");
        fails(ask(at, 1, 6, room.byte_add(4), 144), Status::Pointer, "not aligned");
        fails(ask(room, 1, 6, room, 144), Status::Pointer, "overlap");
        ok(ask(null(), 0, 6, null_mut(), 0));
        let wrong = [0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0];
        fails(ask(wrong.as_ptr(), 1, 6, room, 144), Status::Value, "value 2 of the configuration");
        let mut touching = false;
        let ask = |q: &[f64; 6], out| urdd_proximity_in_collision(made, q.as_ptr(), 1, 6, out);
        fails(ask(&[f64::INFINITY; 6], &mut touching), Status::Value, "value 0");
        fails(ask(&[0.0; 6], null_mut()), Status::Pointer, "`colliding` is null");
        let mut index = 0;
        fails(
            urdd_robot_link(handle, c"torhc".as_ptr(), &mut index),
            Status::UnknownName,
            "`torch`",
        );
        fails(urdd_robot_link(handle, null(), &mut index), Status::Pointer, "`name` is null");
        fails(urdd_robot_link(handle, c"\xff".as_ptr(), &mut index), Status::Utf8, "not UTF-8");
        let mut name = urdd_version();
        fails(urdd_robot_link_name(handle, 9, &mut name), Status::OutOfRange, "link 9");
        let mut robot = null_mut();
        fails(urdd_robot_open(c"/nowhere".as_ptr(), &mut robot), Status::Open, "/nowhere");
        fails(urdd_robot_open(c"/".as_ptr(), &mut robot), Status::Open, "no URDD in this folder");
        assert!(robot.is_null());
        fails(urdd_robot_open(c"/".as_ptr(), null_mut()), Status::Pointer, "`out` is null");
        let mut other = null_mut();
        fails(
            urdd_robot_proximity(handle, c"cubes".as_ptr(), &mut other),
            Status::UnknownName,
            "`cubes`",
        );
        let mut obstacle = null_mut();
        let half = [1.0, -1.0, 1.0];
        let cube =
            |pose: *const f64, out| urdd_obstacle_cuboid(c"o".as_ptr(), pose, half.as_ptr(), out);
        fails(cube(null(), &mut obstacle), Status::Value, "obstacle `o`");
        fails(cube([0.0; 16].as_ptr(), &mut obstacle), Status::Value, "rotation and a translation");
        let triangle = [0, 1, 7];
        let vertices = [0.0; 9];
        let (at, corners) = (vertices.as_ptr(), triangle.as_ptr());
        let mesh = urdd_obstacle_mesh(c"m".as_ptr(), null(), at, 3, corners, 1, &mut obstacle);
        fails(mesh, Status::OutOfRange, "vertex 7");
        let huge = urdd_obstacle_hull(c"h".as_ptr(), null(), at, usize::MAX, &mut obstacle);
        fails(huge, Status::Length, "more than any memory");
        let mut model = null_mut();
        let gone = urdd_robot_collision_model(handle, &mut model);
        fails(gone, Status::MissingModule, "self_collision_model");
        for status in
            [urdd_robot_free(null_mut()), urdd_proximity_free(made), urdd_robot_free(handle)]
        {
            ok(status);
        }
    }
}

/// A contract that debug builds of the library check.
#[test]
fn handles_that_are_freed_or_of_another_type_are_found_in_debug_builds() {
    if !cfg!(debug_assertions) {
        return;
    }
    let handle = open();
    let made = proximity(handle, "hulls");
    let mut links = 0;
    // SAFETY: debug builds look handles up before they follow them.
    unsafe {
        let sizes =
            |handle: *const Robot, links| urdd_robot_sizes(handle, links, null_mut(), null_mut());
        fails(sizes(made.cast(), &mut links), Status::Handle, "found a urdd_proximity");
        ok(urdd_robot_free(handle));
        fails(sizes(handle, &mut links), Status::Handle, "not open");
        fails(urdd_robot_free(handle), Status::Handle, "not open");
        ok(urdd_proximity_free(made));
    }
}

#[test]
fn many_threads_ask_one_handle() {
    let (handle, q) = (open(), samples(200));
    let made = proximity(handle, "pieces");
    let (address, mut expected) = (made.addr(), vec![false; 200]);
    // SAFETY: as the header says: handles do not change.
    unsafe {
        ok(urdd_proximity_in_collision(made, q.as_ptr(), 200, 6, expected.as_mut_ptr()));
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    let made = std::ptr::with_exposed_provenance::<Proximity>(address);
                    for (row, expected) in q.chunks(6).zip(&expected) {
                        let mut found = false;
                        ok(urdd_proximity_in_collision(made, row.as_ptr(), 1, 6, &mut found));
                        assert_eq!(found, *expected);
                    }
                    // Each thread has its own text.
                    let name: *const c_char = null();
                    let mut robot = null_mut();
                    fails(urdd_robot_open(name, &mut robot), Status::Pointer, "`path` is null");
                });
            }
        });
        ok(urdd_proximity_free(made));
        ok(urdd_robot_free(handle));
    }
}

#[test]
fn what_planners_ask_is_what_rust_answers() {
    let robot = arm();
    let known = robot.proximity(ShapeKind::Pieces).expect("shapes");
    let dofs = known.num_dofs();
    let all = samples(80);
    let (q, ends) = all.split_at(40 * dofs);
    let torch = robot.link("torch").expect("torch");
    let object = urdd_robot::Obstacle::sphere("part", [0.0, 0.0, 0.1], 0.05).expect("a sphere");
    let known = known.attach(torch, &object).expect("attached");
    let post = urdd_robot::Obstacle::sphere("post", [0.0; 3], 0.1).expect("a sphere");
    let mut pose = Isometry3::identity();
    pose.translation.vector = Vector3::new(0.5, 0.2, 0.4);
    let moved = post.at(pose).expect("moved");
    let around = known.world_proximity(&World::new([moved]));
    let around = around.expect("a world");
    // SAFETY: as the header says.
    unsafe {
        let (handle, mut with, mut none) = (open(), null_mut(), null_mut());
        let alone = proximity(handle, "pieces");
        let (mut part, mut post, mut moved, mut world) =
            (null_mut(), null_mut(), null_mut(), null_mut());
        let centres = [[0.0, 0.0, 0.1], [0.0; 3]];
        ok(urdd_obstacle_sphere(c"part".as_ptr(), centres[0].as_ptr(), 0.05, &mut part));
        ok(urdd_proximity_attach(alone, torch, part, &mut with));
        ok(urdd_obstacle_sphere(c"post".as_ptr(), centres[1].as_ptr(), 0.1, &mut post));
        let matrix = pose.to_homogeneous().transpose();
        ok(urdd_obstacle_at(post, matrix.as_ptr(), &mut moved));
        let obstacles = [moved.cast_const()];
        ok(urdd_proximity_world_proximity(with, obstacles.as_ptr(), 1, &mut world));

        let mut within = [[false; 40]; 2];
        let [own, others] = &mut within;
        ok(urdd_proximity_is_within(with, q.as_ptr(), 40, dofs, 0.05, own.as_mut_ptr()));
        ok(urdd_world_proximity_is_within(world, q.as_ptr(), 40, dofs, 0.05, others.as_mut_ptr()));
        let mut blocked = [[0.0; 40]; 2];
        let [own, others] = &mut blocked;
        let (from, to) = (q.as_ptr(), ends.as_ptr());
        ok(urdd_proximity_blocked_edge(with, from, to, 40, dofs, 0.0, 0.05, own.as_mut_ptr()));
        ok(urdd_world_proximity_blocked_edge(
            world,
            from,
            to,
            40,
            dofs,
            0.0,
            0.0,
            others.as_mut_ptr(),
        ));
        let settings = [Some(0.05), None].map(|resolution| EdgeSettings {
            margin: 0.0,
            resolution,
            ..Default::default()
        });
        for (k, row) in q.chunks(dofs).enumerate() {
            assert_eq!(within[0][k], known.is_within(row, 0.05).expect("an answer"));
            assert_eq!(within[1][k], around.is_within(row, 0.05).expect("an answer"));
            let end = &ends[k * dofs..(k + 1) * dofs];
            let expected = [
                known.blocked_edge(row, end, &settings[0]).expect("an answer"),
                around.blocked_edge(row, end, &settings[1]).expect("an answer"),
            ];
            for (found, expected) in blocked.iter().zip(expected) {
                assert!(
                    found[k] == expected.unwrap_or(f64::NAN)
                        || expected.is_none() && found[k].is_nan()
                );
            }

            let near = PairDistance::from(known.nearest(row, 1).expect("pairs").remove(0));
            let (mut pairs, mut gradients, mut found) = ([near; 4], vec![0.0; 4 * dofs], 0);
            ok(urdd_proximity_gradients(
                with,
                row.as_ptr(),
                dofs,
                4,
                pairs.as_mut_ptr(),
                gradients.as_mut_ptr(),
                &mut found,
            ));
            assert_eq!(found, 4);
            for (place, one) in known.gradients(row, 4).expect("pairs").iter().enumerate() {
                assert_eq!(pairs[place].distance, one.pair.distance);
                let own = &gradients[place * dofs..(place + 1) * dofs];
                match &one.gradient {
                    Some(gradient) => assert_eq!(own, gradient),
                    None => assert!(own.iter().all(|value| value.is_nan())),
                }
            }
            let nearest = ObstacleDistance::from(around.nearest(row, 1).expect("pairs").remove(0));
            let mut pairs = [nearest; 2];
            ok(urdd_world_proximity_gradients(
                world,
                row.as_ptr(),
                dofs,
                2,
                pairs.as_mut_ptr(),
                gradients[..2 * dofs].as_mut_ptr(),
                &mut found,
            ));
            let expected = &around.gradients(row, 2).expect("pairs")[1];
            assert_eq!(pairs[1].distance, expected.pair.distance);
            if let Some(gradient) = &expected.gradient {
                assert_eq!(&gradients[dofs..2 * dofs], gradient);
            }

            let expected = known.penetrations(row).expect("overlaps");
            let empty = Overlap { pair: near, depth: f64::NAN, direction: [0.0; 3] };
            // Room for one less than there are.
            let mut overlaps = vec![empty; expected.len().saturating_sub(1)];
            let (at, length) = (overlaps.as_mut_ptr(), overlaps.len());
            let at = if length == 0 { null_mut() } else { at };
            ok(urdd_proximity_penetrations(with, row.as_ptr(), dofs, at, length, &mut found));
            assert_eq!(found, expected.len());
            for (found, one) in overlaps.iter().zip(&expected) {
                assert_eq!((found.depth, found.direction), (one.depth, one.direction));
                assert_eq!(found.pair.points, one.pair.points);
            }
        }
        let wrong =
            urdd_proximity_is_within(with, q.as_ptr(), 1, dofs, -1.0, within[0].as_mut_ptr());
        fails(wrong, Status::Value, "margin");
        fails(urdd_proximity_attach(with, torch, part, &mut none), Status::Value, "has this name");
        assert!(none.is_null());
        for handle in [part, post, moved] {
            ok(urdd_obstacle_free(handle));
        }
        ok(urdd_world_proximity_free(world));
        ok(urdd_proximity_free(with));
        ok(urdd_proximity_free(alone));
        ok(urdd_robot_free(handle));
    }
}
