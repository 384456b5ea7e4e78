//! What the C interface costs: the same questions through it and in Rust, in one run.
//!
//!     cargo bench -p urdd-c --bench border [URDD]
//!
//! Without a URDD, one is generated of the welding arm.

// A bench may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

use std::ffi::CString;
use std::hint::black_box;
use std::path::PathBuf;
use std::ptr::null_mut;
use std::time::Instant;

use urdd_c::*;
use urdd_kinematics::pose::write_matrix;
use urdd_robot::spheres::SphereChecker;
use urdd_robot::{Queries, ShapeKind};

/// Seconds of a call: the least of several rounds, each long enough for the clock.
fn seconds(mut act: impl FnMut(usize)) -> f64 {
    let mut calls = 1;
    let mut least = f64::INFINITY;
    for _ in 0..7 {
        let spent = loop {
            let began = Instant::now();
            (0..calls).for_each(&mut act);
            let spent = began.elapsed().as_secs_f64();
            if spent > 0.1 {
                break spent;
            }
            calls *= 2;
        };
        least = least.min(spent / calls as f64);
    }
    least
}

fn row(what: &str, mut c: impl FnMut(usize), mut rust: impl FnMut(usize)) {
    // In turns, so that both see the same machine.
    let (mut through, mut plain) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..3 {
        plain = plain.min(seconds(&mut rust));
        through = through.min(seconds(&mut c));
    }
    println!(
        "{what:28} {:12.1} ns in Rust {:12.1} ns in C {:+8.1} ns {:+6.1} %",
        plain * 1e9,
        through * 1e9,
        (through - plain) * 1e9,
        (through / plain - 1.0) * 100.0
    );
}

fn main() {
    let word = std::env::args().skip(1).find(|word| !word.starts_with("--"));
    let arm = testkit::repository().join("conformance/robots/welding_arm.urdf");
    let (_guard, path) = match word {
        Some(path) => (None, PathBuf::from(path)),
        None => {
            let (guard, path) = testkit::robots::made(&arm);
            (Some(guard), path)
        }
    };
    let robot = urdd_robot::Robot::open(&path).unwrap();
    let proximity = robot.proximity(ShapeKind::Pieces).unwrap();
    let name = CString::new(path.to_str().unwrap()).unwrap();
    let (mut handle, mut shapes) = (null_mut(), null_mut());
    // SAFETY: as the header says.
    unsafe {
        assert_eq!(urdd_robot_open(name.as_ptr(), &mut handle), Status::Ok);
        let made = urdd_robot_proximity(handle, c"pieces".as_ptr(), &mut shapes);
        assert_eq!(made, Status::Ok);
    }
    // One sphere around each piece.
    let level = proximity.bounding_level();
    let known =
        SphereChecker::covering(&robot, std::slice::from_ref(&level), &proximity.link_pairs())
            .unwrap();
    let each = level.links.iter().flat_map(|own| own.spheres.iter().map(|of| (own.link_idx, of)));
    let sphere = |(link, of): (usize, &urdd_robot::spheres::Sphere)| LinkSphere {
        level: 0,
        link,
        centre: of.centre,
        radius: of.radius,
    };
    let spheres: Vec<LinkSphere> = each.map(sphere).collect();
    let link_pairs = proximity.link_pairs().into_iter().map(|links| LinkPair { links });
    let link_pairs: Vec<LinkPair> = link_pairs.collect();
    let mut checker = null_mut();
    // SAFETY: as the header says.
    unsafe {
        let (at, count, of) = (spheres.as_ptr(), spheres.len(), link_pairs.as_ptr());
        let made =
            urdd_robot_covering_checker_of(handle, at, count, of, link_pairs.len(), &mut checker);
        assert_eq!(made, Status::Ok);
    }
    let (dofs, links, pairs) = (
        robot.dof_names().unwrap().len(),
        robot.link_names().unwrap().len(),
        proximity.num_pairs(),
    );
    const ROWS: usize = 1000;
    let space = robot.configurations().unwrap();
    let all: Vec<f64> = (0..ROWS as u64).flat_map(|k| space.random(k)).collect();
    let q = |k: usize| &all[dofs * (k % ROWS)..dofs * (k % ROWS + 1)];
    let ok = |status| assert_eq!(status, Status::Ok);

    println!("{links} links, {dofs} DOFs, {pairs} pairs");
    // Both as matrices; below, Rust's batch has quaternions, half as many bytes.
    let (mut poses, mut out, mut matrices) =
        (Vec::new(), vec![0.0; 16 * links], vec![0.0; 16 * links]);
    row(
        "poses as matrices",
        // SAFETY: as the header says.
        |k| unsafe {
            let at = q(k).as_ptr();
            ok(urdd_robot_link_poses(handle, at, 1, dofs, out.as_mut_ptr(), 16 * links));
        },
        |k| {
            robot.link_poses_into(q(k), &mut poses).unwrap();
            for (pose, out) in poses.iter().zip(matrices.chunks_exact_mut(16)) {
                write_matrix(pose, out);
            }
            black_box(&matrices);
        },
    );
    let mut touches = false;
    row(
        "in collision",
        // SAFETY: as the header says.
        |k| unsafe {
            ok(urdd_proximity_in_collision(shapes, q(k).as_ptr(), 1, dofs, &mut touches))
        },
        |k| {
            black_box(proximity.in_collision(q(k)).unwrap());
        },
    );
    let mut answer = CoveringAnswer::Maybe;
    row(
        "in collision by spheres",
        // SAFETY: as the header says.
        |k| unsafe {
            ok(urdd_covering_checker_in_collision(checker, q(k).as_ptr(), 1, dofs, &mut answer))
        },
        |k| {
            black_box(known.in_collision(q(k)).unwrap());
        },
    );
    let mut covered = vec![CoveringAnswer::Maybe; ROWS];
    row(
        "1,000 in collision by spheres",
        // SAFETY: as the header says.
        |_| unsafe {
            let at = covered.as_mut_ptr();
            ok(urdd_covering_checker_in_collision(checker, all.as_ptr(), ROWS, dofs, at));
        },
        |_| {
            black_box(known.in_collision_batch(&all).unwrap());
        },
    );
    let (mut distances, mut c) = (vec![0.0; pairs], vec![0.0; pairs]);
    row(
        "distances",
        // SAFETY: as the header says.
        |k| unsafe {
            let at = q(k).as_ptr();
            ok(urdd_proximity_distances(shapes, at, 1, dofs, c.as_mut_ptr(), pairs));
        },
        |k| proximity.distances_into(q(k), &mut distances).unwrap(),
    );
    let mut out = vec![0.0; 16 * links * ROWS];
    row(
        "1,000 poses",
        // SAFETY: as the header says.
        |_| unsafe {
            let (at, length) = (out.as_mut_ptr(), out.len());
            ok(urdd_robot_link_poses(handle, all.as_ptr(), ROWS, dofs, at, length));
        },
        |_| {
            black_box(robot.link_poses_batch(&all).unwrap());
        },
    );
    let mut answers = vec![false; ROWS];
    row(
        "1,000 in collision",
        // SAFETY: as the header says.
        |_| unsafe {
            let at = answers.as_mut_ptr();
            ok(urdd_proximity_in_collision(shapes, all.as_ptr(), ROWS, dofs, at));
        },
        |_| {
            black_box(proximity.in_collision_batch(&all).unwrap());
        },
    );
    let mut out = vec![0.0; pairs * ROWS];
    row(
        "1,000 distances",
        // SAFETY: as the header says.
        |_| unsafe {
            let (at, length) = (out.as_mut_ptr(), out.len());
            ok(urdd_proximity_distances(shapes, all.as_ptr(), ROWS, dofs, at, length));
        },
        |_| {
            black_box(proximity.distances_batch(&all).unwrap());
        },
    );
    // SAFETY: as the header says.
    unsafe {
        ok(urdd_covering_checker_free(checker));
        ok(urdd_proximity_free(shapes));
        ok(urdd_robot_free(handle));
    }
}
