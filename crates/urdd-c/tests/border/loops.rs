//! Kinematic loops: C has what Rust has, to the bit, and an error for what a caller does wrong.

use std::path::PathBuf;
use std::ptr::{null, null_mut};
use std::sync::LazyLock;

use testkit::looped::{FOUR_BAR, four_bar, four_bar_at};
use urdd_c::*;
use urdd_robot::{CloseSettings, EdgeSettings, Queries, ShapeKind};

use crate::interface::{c, fails, ok, proximity, text};

static MADE: LazyLock<(tempfile::TempDir, PathBuf)> =
    LazyLock::new(|| testkit::robots::made_of(&four_bar(FOUR_BAR, "")));

/// The four-bar in C and in Rust.
pub fn open() -> (*mut Robot, urdd_robot::Robot) {
    let (path, mut robot) = (c(MADE.1.to_str().expect("UTF-8")), null_mut());
    // SAFETY: as the header says.
    ok(unsafe { urdd_robot_open(path.as_ptr(), &mut robot) });
    (robot, urdd_robot::Robot::open(&MADE.1).expect("a robot"))
}

const ROWS: usize = 5;

/// Closed configurations, and nearly closed ones.
fn rows() -> ([f64; 3 * ROWS], [f64; 3 * ROWS]) {
    let mut closed = [0.0; 3 * ROWS];
    for (k, row) in closed.chunks_exact_mut(3).enumerate() {
        row.copy_from_slice(&four_bar_at(FOUR_BAR, 0.4 * k as f64, -1.0));
    }
    let mut near = closed;
    near.iter_mut().skip(1).step_by(3).for_each(|coupler| *coupler += 0.02);
    (closed, near)
}

#[test]
fn loops_are_those_of_rust() {
    let (handle, robot) = open();
    let (closed, near) = rows();
    let (at, from) = (closed.as_ptr(), near.as_ptr());
    // SAFETY: as the header says.
    unsafe {
        let (mut loops, mut couplings, mut equations, mut free) = (0, 9, 0, 0);
        ok(urdd_robot_loop_sizes(handle, &mut loops, &mut couplings, &mut equations, &mut free));
        assert_eq!((loops, couplings, equations, free), (1, 0, 5, 1));
        ok(urdd_robot_loop_sizes(handle, null_mut(), null_mut(), null_mut(), null_mut()));
        let mut name = urdd_version();
        ok(urdd_robot_loop_name(handle, 0, &mut name));
        assert_eq!(text(name), "pin");
        fails(urdd_robot_loop_name(handle, 1, &mut name), Status::OutOfRange, "loop 1");
        fails(urdd_robot_coupling_name(handle, 0, &mut name), Status::OutOfRange, "coupling 0");
        let mut independent = [9];
        ok(urdd_robot_independent_dofs(handle, independent.as_mut_ptr(), 1));
        assert_eq!(independent, [0]);
        let mut reference = [0.0; 3];
        ok(urdd_robot_reference_configuration(handle, reference.as_mut_ptr(), 3));
        assert_eq!(&reference[..], robot.reference_configuration().expect("one"));

        let (mut gaps, mut is_closed) = ([0.0; 2 * ROWS], [true; ROWS]);
        let (out, none) = (gaps.as_mut_ptr(), null_mut());
        let said = is_closed.as_mut_ptr();
        ok(urdd_robot_loop_errors(handle, from, ROWS, 3, out, 2 * ROWS, none, 0, said));
        assert_eq!(is_closed, [false; ROWS]);
        for (k, gap) in gaps.as_chunks::<2>().0.iter().enumerate() {
            let expected = robot.loop_errors(&near[3 * k..3 * k + 3]).expect("gaps").gaps[0];
            assert_eq!(*gap, [expected.position, expected.rotation]);
        }

        let (mut found, held) = ([0.0; 3 * ROWS], [0]);
        let settings = CloseSettings { held: &held, bounds: None };
        let known = robot.close_batch(&near, &settings).expect("answers");
        let (out, held) = (found.as_mut_ptr(), held.as_ptr());
        ok(urdd_robot_close(handle, from, ROWS, 3, held, 1, null(), 0, out, said));
        assert_eq!((&found[..], &is_closed[..]), (&*known.configurations, &*known.is_closed));
        let one = is_closed.as_mut_ptr();
        let mut alone = [0.0; 3];
        ok(urdd_robot_close(handle, from, 1, 3, held, 1, null(), 0, alone.as_mut_ptr(), one));
        assert_eq!(alone, found[..3]);
        let tight = [-9.0, 9.0, -9.0, 9.0, closed[2] + 1.0, 9.0];
        let bounds = tight.as_ptr();
        ok(urdd_robot_close(handle, from, 1, 3, held, 1, bounds, 6, alone.as_mut_ptr(), one));
        assert!(!is_closed[0] && alone[2] >= closed[2] + 1.0);

        let mut free = [false; 3];
        ok(urdd_robot_free_dofs(handle, at, 3, free.as_mut_ptr()));
        assert_eq!(free, [true, false, false]);
        let (mut residuals, mut jacobians) = ([0.0; 5 * ROWS], [0.0; 15 * ROWS]);
        ok(urdd_robot_loop_residuals(handle, from, ROWS, 3, residuals.as_mut_ptr(), 5 * ROWS));
        ok(urdd_robot_loop_jacobians(handle, at, ROWS, 3, jacobians.as_mut_ptr(), 15 * ROWS));
        let mut velocities = [0.0; 3 * ROWS];
        let (speeds, out) = ([1.0, 2.0, 3.0, 4.0, 5.0], velocities.as_mut_ptr());
        ok(urdd_robot_loop_velocities(handle, at, ROWS, 3, speeds.as_ptr(), ROWS, out));
        for (k, speed) in speeds.iter().enumerate() {
            let (q, off) = (&closed[3 * k..3 * k + 3], &near[3 * k..3 * k + 3]);
            let expected = robot.loop_residuals(off).expect("residuals");
            assert_eq!(residuals[5 * k..5 * k + 5], *expected);
            let expected = robot.loop_jacobian(q).expect("a Jacobian");
            assert_eq!(jacobians[15 * k..15 * k + 15], *expected.as_slice());
            let expected = robot.loop_velocities(q, &[*speed]).expect("an answer");
            assert_eq!(velocities[3 * k..3 * k + 3], *expected.expect("they follow"));
        }
        ok(urdd_robot_free(handle));
    }
}

#[test]
fn motions_say_what_stops_them() {
    let (handle, robot) = open();
    let known = robot.proximity(ShapeKind::Hulls).expect("shapes");
    let (start, end) = (four_bar_at(FOUR_BAR, 0.3, -1.0), four_bar_at(FOUR_BAR, 1.0, -1.0));
    let other = four_bar_at(FOUR_BAR, 1.0, 1.0);
    // SAFETY: as the header says.
    unsafe {
        let shapes = proximity(handle, "hulls");
        let mut found = Motion::default();
        let ask = |to: &[f64; 3], resolution: f64, open_loops: bool, out: &mut Motion| {
            let (from, to) = (start.as_ptr(), to.as_ptr());
            urdd_proximity_motions(shapes, from, to, 1, 3, 0.0, resolution, open_loops, out)
        };
        ok(ask(&end, 0.01, false, &mut found));
        assert!(found.free.is_nan() && found.blocked.is_nan());
        assert_eq!(found.obstruction, Obstruction::None);
        ok(ask(&other, 0.01, false, &mut found));
        assert_eq!((found.blocked, found.obstruction), (1.0, Obstruction::Branch));
        let settings = EdgeSettings::default();
        let expected = known.first_contact(&start, &other, &settings).expect("an answer");
        assert_eq!(found.free, expected.expect("blocked").free);
        ok(ask(&other, 0.0, true, &mut found));
        assert_eq!(found.obstruction, Obstruction::None);
        fails(ask(&end, 0.0, false, &mut found), Status::Value, "resolution");
        let open = [end[0], end[1] + 0.1, end[2]];
        fails(ask(&open, 0.01, false, &mut found), Status::Value, "the loop `pin` is");
        let mut blocked = 0.0;
        let (from, to) = (start.as_ptr(), other.as_ptr());
        ok(urdd_proximity_blocked_edge(shapes, from, to, 1, 3, 0.0, 0.01, &mut blocked));
        assert_eq!(blocked, 1.0);
        ok(urdd_proximity_free(shapes));
        ok(urdd_robot_free(handle));
    }
}

#[test]
fn what_a_caller_does_wrong_has_a_status() {
    let (handle, _robot) = open();
    let (closed, _) = rows();
    let q = closed.as_ptr();
    let (mut out, mut said) = ([0.0; 15], [false; ROWS]);
    let (out, said) = (out.as_mut_ptr(), said.as_mut_ptr());
    // SAFETY: as the header says.
    unsafe {
        let close = |held: &[usize], bounds: &[f64]| {
            let (held, count) = (held.as_ptr(), held.len());
            let at = if bounds.is_empty() { null() } else { bounds.as_ptr() };
            urdd_robot_close(handle, q, 1, 3, held, count, at, bounds.len(), out, said)
        };
        fails(close(&[3], &[]), Status::OutOfRange, "DOF 3");
        fails(close(&[], &[0.0; 5]), Status::Length, "`bounds` has 5 values: expected 6");
        fails(close(&[], &[1.0, 0.0, 1.0, 0.0, 1.0, 0.0]), Status::Value, "lower first");
        let none = null_mut();
        let errors = urdd_robot_loop_errors(handle, q, 1, 3, out, 3, none, 0, said);
        fails(errors, Status::Length, "`gaps` has room for 3 values: expected 2");
        fails(urdd_robot_loop_residuals(handle, q, 1, 3, out, 4), Status::Length, "expected 5");
        fails(urdd_robot_loop_jacobians(handle, q, 1, 3, out, 5), Status::Length, "expected 15");
        let speeds = [1.0, f64::NAN];
        let at = speeds.as_ptr();
        fails(urdd_robot_loop_velocities(handle, q, 1, 3, at, 2, out), Status::Length, "1 x 1");
        fails(
            urdd_robot_loop_velocities(handle, q, 1, 3, at.add(1), 1, out),
            Status::Value,
            "finite",
        );
        fails(urdd_robot_loop_residuals(handle, q, 1, 2, out, 5), Status::Length, "expected 3");
        ok(urdd_robot_free(handle));
    }
}
