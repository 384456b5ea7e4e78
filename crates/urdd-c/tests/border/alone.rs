//! Where there are no threads to answer a batch, and no memory of a thread: in a child of `fork`, and where a thread ends.

use std::cell::Cell;
use std::ptr::{null, null_mut};

use urdd_c::*;

use crate::interface::{arm_path, ok, open, samples, text};

unsafe extern "C" {
    fn fork() -> i32;
    fn waitpid(process: i32, status: *mut i32, options: i32) -> i32;
    fn alarm(seconds: u32) -> u32;
    fn _exit(status: i32) -> !;
}

const ROWS: usize = 500;

/// Every call that runs on the pool, on a robot that is read here.
fn answers(q: &[f64]) -> (Vec<bool>, Vec<f64>, Vec<f64>, String) {
    let mut colliding = vec![false; ROWS];
    let (mut least, mut found) = (vec![0.0; ROWS], vec![0.0; 6 * 8]);
    let (mut proximity, mut mesh, mut world, mut report) =
        (null_mut(), null_mut(), null_mut(), null_mut());
    let vertices: [[f64; 3]; 4] = [[0.0; 3], [0.3, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 0.3]];
    let triangles: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let path = arm_path();
    // SAFETY: as the header says.
    unsafe {
        let robot = open();
        let (mut links, mut poses) = (0, vec![0.0; 16 * 9 * ROWS]);
        ok(urdd_robot_sizes(robot, &mut links, null_mut(), null_mut()));
        ok(urdd_robot_link_poses(robot, q.as_ptr(), ROWS, 6, poses.as_mut_ptr(), poses.len()));
        ok(urdd_robot_proximity(robot, c"pieces".as_ptr(), &mut proximity));
        ok(urdd_proximity_in_collision(proximity, q.as_ptr(), ROWS, 6, colliding.as_mut_ptr()));
        let (at, corners) = (vertices.as_ptr().cast(), triangles.as_ptr().cast());
        ok(urdd_obstacle_mesh(c"mesh".as_ptr(), null(), at, 4, corners, 4, &mut mesh));
        let obstacles = [mesh.cast_const()];
        ok(urdd_proximity_world_proximity(proximity, obstacles.as_ptr(), 1, &mut world));
        ok(urdd_world_proximity_min_distance(world, q.as_ptr(), ROWS, 6, least.as_mut_ptr()));
        let target = |k: usize| Target {
            link: links - 1,
            pose: poses[16 * (9 * k + links - 1)..][..16].try_into().expect("16 values"),
            point: [0.0; 3],
            is_position: false,
            weights: [0.0; 6],
        };
        let targets: Vec<Target> = (0..8).map(target).collect();
        let mut solutions = [Solution::default(); 8];
        let (targets, at) = (targets.as_ptr(), found.as_mut_ptr());
        let room = solutions.as_mut_ptr();
        ok(urdd_robot_inverse_kinematics(robot, targets, 8, q.as_ptr(), 8, 6, null(), at, room));
        ok(urdd_validate(path.as_ptr(), null(), &mut report));
        let mut json = urdd_version();
        ok(urdd_report_json(report, &mut json));
        let json = text(json);
        ok(urdd_report_free(report));
        ok(urdd_world_proximity_free(world));
        ok(urdd_obstacle_free(mesh));
        ok(urdd_proximity_free(proximity));
        ok(urdd_robot_free(robot));
        (colliding, least, found, json)
    }
}

#[test]
#[ignore = "`a_child_of_fork_answers_as_its_parent_does` starts it in a process of its own"]
fn forked() {
    let q = samples(ROWS as u64);
    let known = answers(&q);
    // SAFETY: no other thread of this process is in the library.
    let child = unsafe { fork() };
    if child == 0 {
        // SAFETY: a call that hangs ends the child.
        unsafe { alarm(60) };
        let found = std::panic::catch_unwind(|| {
            assert!(answers(&q) == known);
            let other = std::thread::scope(|scope| scope.spawn(|| answers(&q)).join());
            assert!(other.expect("answers of another thread of the child") == known);
        });
        // SAFETY: nothing of the parent's is written twice.
        unsafe { _exit(i32::from(found.is_err())) };
    }
    let mut status = -1;
    // SAFETY: there is room for a status.
    assert_eq!(unsafe { waitpid(child, &mut status, 0) }, child);
    assert_eq!(status, 0, "the child ended with {status:#x}");
}

#[test]
fn a_child_of_fork_answers_as_its_parent_does() {
    let program = std::env::current_exe().expect("this program");
    let mut test = std::process::Command::new(program);
    let output = test.args(["--exact", "alone::forked", "--ignored"]).output().expect("started");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    assert!(String::from_utf8_lossy(&output.stdout).contains("1 passed"));
}

thread_local! {
    static FAREWELL: Farewell = const { Farewell(Cell::new(0)) };
}

/// Asks while its thread ends, after the library's own variables of the thread are gone.
struct Farewell(Cell<usize>);

impl Drop for Farewell {
    fn drop(&mut self) {
        let proximity = std::ptr::with_exposed_provenance::<Proximity>(self.0.get());
        let (q, mut touches, mut robot) = (samples(1), false, null_mut());
        // SAFETY: as the header says.
        unsafe {
            ok(urdd_proximity_in_collision(proximity, q.as_ptr(), 1, 6, &mut touches));
            assert_eq!(urdd_robot_open(null(), &mut robot), Status::Pointer);
        }
        assert!(text(urdd_error_message()).contains("the message is gone"));
    }
}

#[test]
fn a_thread_that_ends_is_answered() {
    let (robot, mut proximity) = (open(), null_mut());
    // SAFETY: as the header says.
    ok(unsafe { urdd_robot_proximity(robot, c"hulls".as_ptr(), &mut proximity) });
    let address = proximity.expose_provenance();
    let thread = std::thread::spawn(move || {
        FAREWELL.with(|farewell| farewell.0.set(address));
        let mut touches = false;
        let proximity = std::ptr::with_exposed_provenance::<Proximity>(address);
        // SAFETY: as the header says. The library's variables of this thread come after this test's, and go before.
        unsafe {
            ok(urdd_proximity_in_collision(proximity, samples(1).as_ptr(), 1, 6, &mut touches));
            assert_eq!(urdd_robot_open(null(), &mut null_mut()), Status::Pointer);
        }
    });
    thread.join().expect("answers, and no end of the process");
    // SAFETY: as the header says.
    unsafe {
        ok(urdd_proximity_free(proximity));
        ok(urdd_robot_free(robot));
    }
}
