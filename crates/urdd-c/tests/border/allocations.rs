//! What a control loop asks does not allocate after its first round.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::ffi::CString;
use std::ptr::{null, null_mut};

use urdd_c::*;

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
    /// The bytes that this thread can still take.
    pub static LEFT: Cell<usize> = const { Cell::new(UNLIMITED) };
}

pub const UNLIMITED: usize = usize::MAX;

struct Counting;

// SAFETY: the system's allocator, counted.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = COUNT.try_with(|count| count.set(count.get() + 1));
        let take = |left: &Cell<usize>| match left.get() {
            UNLIMITED => true,
            known => known.checked_sub(layout.size()).map(|rest| left.set(rest)).is_some(),
        };
        if !LEFT.try_with(take).unwrap_or(true) {
            return null_mut();
        }
        // SAFETY: guaranteed by the caller.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        let _ = LEFT.try_with(|left| left.set(left.get().saturating_add(layout.size())));
        // SAFETY: guaranteed by the caller.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn a_control_loop_does_not_allocate() {
    let urdf = testkit::repository().join("conformance/robots/welding_arm.urdf");
    let (_guard, folder) = testkit::robots::made(&urdf);
    let path = CString::new(folder.to_str().expect("UTF-8")).expect("no zero byte");
    let (mut robot, mut made, mut world, mut ball) =
        (null_mut(), null_mut(), null_mut(), null_mut());
    // SAFETY: as the header says.
    unsafe {
        let ok = |status| assert_eq!(status, Status::Ok);
        ok(urdd_robot_open(path.as_ptr(), &mut robot));
        ok(urdd_robot_proximity(robot, c"pieces".as_ptr(), &mut made));
        let centre = [0.6, 0.0, 0.4];
        ok(urdd_obstacle_sphere(c"ball".as_ptr(), centre.as_ptr(), 0.1, &mut ball));
        let obstacles = [ball.cast_const()];
        ok(urdd_proximity_world_proximity(made, obstacles.as_ptr(), 1, &mut world));
        let mut pairs = 0;
        ok(urdd_proximity_sizes(made, null_mut(), &mut pairs, null_mut()));
        let (mut covering, mut approximating) = (null_mut(), null_mut());
        let sphere = |link| LinkSphere { level: 0, link, centre: [0.0; 3], radius: 0.1 };
        let (spheres, links) = ([0, 4, 8].map(sphere), LinkPair { links: [0, 8] });
        let mut alone = null_mut();
        ok(urdd_robot_covering_checker_of(robot, spheres.as_ptr(), 3, &links, 1, &mut alone));
        ok(urdd_covering_checker_around(alone, obstacles.as_ptr(), 1, &mut covering));
        ok(urdd_covering_checker_free(alone));
        let (at, of) = (spheres.as_ptr(), &raw const links);
        ok(urdd_robot_approximating_checker_of(robot, at, 3, of, 1, &mut approximating));
        let (mut poses, mut jacobian) = (vec![0.0; 9 * 16], [0.0; 36]);
        let (mut distances, mut q) = (vec![0.0; pairs], [0.0; 6]);
        let pair = Pair { links: [0; 2], bodies: [0; 2], pieces: [0; 2] };
        let (distance, points) = (0.0, [[0.0; 3]; 2]);
        let mut near = [PairDistance { pair, distance, relative: 0.0, points }; 5];
        let (link, body, piece, obstacle) = (0, 0, 0, 0);
        let none = ObstacleDistance { link, body, piece, obstacle, distance, points };
        let (mut near_world, mut gradients, mut found) = ([none; 5], [0.0; 30], 0);
        let mut around = 0;
        ok(urdd_world_proximity_sizes(world, &mut around, null_mut(), null_mut()));
        let mut around = vec![0.0; around];
        let mut before = 0;
        for k in 0..1000 {
            if k == 50 {
                before = COUNT.get();
            }
            q = q.map(|value| value + 0.001);
            let (at, mut touches, mut d) = (q.as_ptr(), false, 0.0);
            ok(urdd_robot_link_poses(robot, at, 1, 6, poses.as_mut_ptr(), 144));
            ok(urdd_robot_jacobians(robot, at, 1, 6, 8, null(), jacobian.as_mut_ptr(), 36));
            let torques = jacobian.as_mut_ptr();
            ok(urdd_robot_gravity_torques(robot, at, 1, 6, null(), 1.0, 8, null(), torques, 6));
            ok(urdd_proximity_in_collision(made, at, 1, 6, &mut touches));
            ok(urdd_proximity_self_distance(made, at, 1, 6, &mut d));
            ok(urdd_proximity_distances(made, at, 1, 6, distances.as_mut_ptr(), pairs));
            ok(urdd_world_proximity_in_collision(world, at, 1, 6, &mut touches));
            let matrix = [1., 0., 0., 0.6, 0., 1., 0., d, 0., 0., 1., 0.4, 0., 0., 0., 1.];
            ok(urdd_world_proximity_move_obstacles(world, 0, matrix.as_ptr(), 1));
            ok(urdd_world_proximity_min_distance(world, at, 1, 6, &mut d));
            ok(urdd_world_proximity_distances(world, at, 1, 6, around.as_mut_ptr(), around.len()));
            ok(urdd_covering_checker_move_obstacles(covering, 0, matrix.as_ptr(), 1));
            let (mut maybe, mut contact) = (CoveringAnswer::Maybe, ApproximateAnswer::Contact);
            ok(urdd_covering_checker_in_collision(covering, at, 1, 6, &mut maybe));
            let within = urdd_approximating_checker_is_within;
            ok(within(approximating, at, 1, 6, 0.1, &mut contact));
            let (end, mut part, mut parts) = (q.map(|value| value + 0.1), 0.0, [0.0; 2]);
            let (edge, end) = (urdd_covering_checker_blocked_edge, end.as_ptr());
            ok(edge(covering, at, end, 1, 6, 0.0, 0.01, false, &mut part));
            let (first, room) = (urdd_covering_checker_first_contact, parts.as_mut_ptr());
            ok(first(covering, at, end, 1, 6, 0.0, 0.01, false, room, 2));
            let near = near.as_mut_ptr();
            ok(urdd_proximity_nearest(made, at, 1, 6, 5, near, &mut found));
            let gradients = gradients.as_mut_ptr();
            ok(urdd_proximity_gradients(made, at, 6, 5, near, gradients, &mut found));
            let near = near_world.as_mut_ptr();
            ok(urdd_world_proximity_nearest(world, at, 1, 6, 5, near, &mut found));
            ok(urdd_world_proximity_gradients(world, at, 6, 5, near, gradients, &mut found));
        }
        assert!(before > 0);
        assert_eq!(COUNT.get() - before, 0);
        ok(urdd_covering_checker_free(covering));
        ok(urdd_approximating_checker_free(approximating));
        ok(urdd_robot_free(robot));
        ok(urdd_proximity_free(made));
        ok(urdd_obstacle_free(ball));
        ok(urdd_world_proximity_free(world));
    }
}

/// A leg of six rods that moves: each round closes it from the last one.
#[test]
fn closing_loops_in_a_control_loop_does_not_allocate() {
    let (_guard, folder) = testkit::robots::made_of(&testkit::looped::leg());
    let path = CString::new(folder.to_str().expect("UTF-8")).expect("no zero byte");
    let mut robot = null_mut();
    // SAFETY: as the header says.
    unsafe {
        let ok = |status| assert_eq!(status, Status::Ok);
        ok(urdd_robot_open(path.as_ptr(), &mut robot));
        let (mut held, mut q, mut closed) = ([0; 6], [0.0; 21], [0.0; 21]);
        ok(urdd_robot_independent_dofs(robot, held.as_mut_ptr(), 6));
        ok(urdd_robot_reference_configuration(robot, q.as_mut_ptr(), 21));
        let (mut residuals, mut jacobian) = ([0.0; 15], [0.0; 15 * 21]);
        let (speeds, mut velocities, mut is_closed) = ([0.01; 6], [0.0; 21], false);
        let mut before = 0;
        for k in 0..200 {
            if k == 50 {
                before = COUNT.get();
            }
            for dof in held {
                q[dof] += 1e-4;
            }
            let (at, free, out) = (q.as_ptr(), held.as_ptr(), closed.as_mut_ptr());
            ok(urdd_robot_close(robot, at, 1, 21, free, 6, null(), 0, out, &mut is_closed));
            assert!(is_closed, "in round {k}");
            q = closed;
            let out = residuals.as_mut_ptr();
            ok(urdd_robot_loop_residuals(robot, at, 1, 21, out, 15));
            let out = jacobian.as_mut_ptr();
            ok(urdd_robot_loop_jacobians(robot, at, 1, 21, out, 15 * 21));
            let out = velocities.as_mut_ptr();
            ok(urdd_robot_loop_velocities(robot, at, 1, 21, speeds.as_ptr(), 6, out));
        }
        assert!(before > 0);
        assert_eq!(COUNT.get() - before, 0);
        ok(urdd_robot_free(robot));
    }
}

#[test]
fn too_little_memory_for_many_targets_is_a_status() {
    let urdf = testkit::repository().join("conformance/robots/welding_arm.urdf");
    let (_guard, folder) = testkit::robots::made(&urdf);
    let path = CString::new(folder.to_str().expect("UTF-8")).expect("no zero byte");
    let mut robot = null_mut();
    let count = 400_000;
    let target =
        Target { link: 8, pose: [0.0; 16], point: [0.0; 3], is_position: true, weights: [0.0; 6] };
    let targets = vec![target; count];
    let (mut found, mut solutions) = (vec![0.0; 6 * count], vec![Solution::default(); count]);
    // SAFETY: as the header says.
    unsafe {
        assert_eq!(urdd_robot_open(path.as_ptr(), &mut robot), Status::Ok);
        let mut ask = |count: usize| {
            let (found, solutions) = (found.as_mut_ptr(), solutions.as_mut_ptr());
            let (at, start) = (targets.as_ptr(), [0.0; 6]);
            let start = start.as_ptr();
            urdd_robot_inverse_kinematics(robot, at, count, start, 1, 6, null(), found, solutions)
        };
        assert_eq!(ask(1), Status::Ok);
        LEFT.set(1 << 20);
        let (one, many) = (ask(1), ask(count));
        LEFT.set(UNLIMITED);
        assert_eq!((one, many), (Status::Ok, Status::Memory));
        assert_eq!(urdd_robot_free(robot), Status::Ok);
    }
}
