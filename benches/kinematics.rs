//! Time for poses, Jacobians and inverse kinematics, on one thread.
//!
//! `cargo bench --bench kinematics -- URDD...` prints for each URDD the median over five rounds of the mean over
//! 10,000 random configurations, in microseconds: the poses of all links, and the Jacobian of the last link by
//! `Robot::jacobian_batch`. Then it takes 1,000 target poses, of all links in turn, in configurations that are not
//! starting points, closed if there are loops. It prints how many `Robot::inverse_kinematics` reaches, and the time;
//! and the time with a posture. For a robot with kinematic loops it also closes 10,000 configurations, each from the
//! last one, in which the independent DOFs are up to 0.005 rad or 0.25 mm elsewhere, and prints how many poses of all
//! links that takes. `--leg` is such a robot: a leg of six rods. It should close within 50 us, or 40 poses.
//!
//! With `--json` it measures nothing: for each URDD and each of 20 configurations, it prints one line with the
//! values, the gravity torques, and for each link its pose (position, then quaternion x, y, z, w) and its Jacobian in
//! column-major order.
//! `tests/figures/kinematics_pinocchio.py` compares these with Pinocchio.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

use std::path::PathBuf;
use std::time::Instant;

use urdd_robot::{CloseSettings, GravitySettings, InverseSettings, Robot, Target};

const CONFIGURATIONS: u64 = 10_000;
const TARGETS: u64 = 1000;
const ROUNDS: usize = 5;

fn main() {
    let given = || std::env::args().skip(1);
    let json = given().any(|argument| argument == "--json");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.expect("a thread");
    if given().any(|argument| argument == "--leg") {
        let (_folder, path) = testkit::robots::made_of(&testkit::looped::leg());
        pool.install(|| measure(&path));
    }
    for path in given().filter(|argument| !argument.starts_with("--")) {
        let path = PathBuf::from(path);
        match json {
            true => print(&path),
            false => pool.install(|| measure(&path)),
        }
    }
}

fn print(path: &std::path::Path) {
    let robot = Robot::open(path).expect("a URDD");
    let space = robot.configurations().expect("configurations");
    let links = robot.link_names().expect("links");
    for k in 0..20 {
        let q = space.random(k);
        let poses = robot.link_poses(&q).expect("poses");
        let of_link = |(link, name): (usize, &String)| {
            let pose = &poses[link];
            let jacobian = robot.jacobian_batch(&q, link).expect("a Jacobian");
            let place = pose.translation.vector.iter();
            let pose: Vec<f64> = place.chain(pose.rotation.coords.iter()).copied().collect();
            serde_json::json!({"link": name, "pose": pose, "jacobian": jacobian})
        };
        let links: Vec<_> = links.iter().enumerate().map(of_link).collect();
        let torques = robot.gravity_torques(&q, &GravitySettings::default()).expect("torques");
        let line = serde_json::json!({"values": q, "links": links, "gravity_torques": torques});
        println!("{line}");
    }
}

fn measure(path: &std::path::Path) {
    let robot = Robot::open(path).expect("a URDD");
    let space = robot.configurations().expect("configurations");
    let all: Vec<Vec<f64>> = (0..CONFIGURATIONS).map(|k| space.random(k)).collect();
    let batch = all.concat();
    let links = robot.link_names().expect("links");
    println!("{}: {} links", path.display(), links.len());
    let mut poses = Vec::new();
    row("poses of links", || {
        for q in &all {
            robot.link_poses_into(q, &mut poses).expect("poses");
        }
    });
    if robot.loops().expect("loops").is_some() {
        close(&robot);
    }
    let last = links.len() - 1;
    row(&format!("Jacobian of {}", links[last]), || {
        std::hint::black_box(robot.jacobian_batch(&batch, last).expect("Jacobians"));
    });
    for with_rotation in [true, false] {
        inverse(&robot, with_rotation);
    }
}

/// A closed configuration in the middle of the bounds of what moves freely, if there is one.
fn middle(robot: &Robot, settings: &CloseSettings) -> Vec<f64> {
    let reference = robot.reference_configuration().expect("a configuration");
    let middle = robot.configurations().expect("configurations").middle();
    let mut q = reference.clone();
    settings.held.iter().for_each(|dof| q[*dof] = middle[*dof]);
    let found = robot.close(&q, settings).expect("an answer");
    found.closed().unwrap_or(reference)
}

/// The way is the same each time.
fn close(robot: &Robot) {
    let units = robot.dof_units().expect("units");
    let held = robot.independent_dofs().expect("DOFs");
    let settings = CloseSettings { held: &held, bounds: None };
    let reference = middle(robot, &settings);
    let mut q = reference.clone();
    let (mut apart, mut poses, mut seconds) = (0, Vec::new(), [0.0; 2]);
    for k in 0..CONFIGURATIONS {
        for dof in &held {
            let most = if units[*dof] == "m" { 0.005 } else { 0.1 };
            let turn = 0.05 * k as f64 + *dof as f64;
            q[*dof] = reference[*dof] + most * (turn.sin() - (*dof as f64).sin());
        }
        let start = Instant::now();
        apart += usize::from(!robot.close_into(&mut q, &settings).expect("an answer"));
        let closed = Instant::now();
        robot.link_poses_into(&q, &mut poses).expect("poses");
        seconds[0] += (closed - start).as_secs_f64();
        seconds[1] += closed.elapsed().as_secs_f64();
    }
    let [closing, poses] = seconds.map(|all| 1e6 * all / CONFIGURATIONS as f64);
    let ratio = closing / poses;
    println!(
        "    closed from a neighbour in {closing:.2} us, {ratio:.1} times the poses of all links; {apart} apart"
    );
}

fn inverse(robot: &Robot, with_rotation: bool) {
    let space = robot.configurations().expect("configurations");
    let links = robot.link_names().expect("links").len() as u64;
    let questions: Vec<(Target, Vec<f64>)> = (0..TARGETS)
        .map(|k| {
            // Numbers that no restart begins with.
            let there = space.random((1 << 20) + k);
            let there = robot.close(&there, &Default::default()).expect("an answer");
            let poses = robot.link_poses(there.configuration());
            let link = (k % links) as usize;
            let pose = poses.expect("poses")[link];
            let target = match with_rotation {
                true => Target::pose(link, pose),
                false => Target::position(link, pose.translation.vector.into()),
            };
            (target, space.random((1 << 21) + k))
        })
        .collect();
    let settings = InverseSettings::default();
    let (mut reached, mut at_once) = (0, 0);
    let start = Instant::now();
    for (target, from) in &questions {
        let found = robot.inverse_kinematics(target, from, &settings);
        let found = found.expect("an answer");
        reached += usize::from(found.is_reached());
        at_once += usize::from(found.is_reached() && found.nearest().restarts == 0);
    }
    let each = 1e6 * start.elapsed().as_secs_f64() / TARGETS as f64;
    let what = if with_rotation { "poses" } else { "places" };
    println!(
        "    {reached} of {TARGETS} {what} reached, {at_once} without a restart, {each:.1} us each"
    );
    let (mut restarts, start) = (0, Instant::now());
    for (k, (target, from)) in (0..).zip(&questions) {
        let posture = Some(space.random((1 << 22) + k));
        let settings = InverseSettings { posture, ..InverseSettings::default() };
        let found = robot.inverse_kinematics(target, from, &settings);
        restarts += found.expect("an answer").nearest().restarts;
    }
    let (each, restarts) =
        (1e6 * start.elapsed().as_secs_f64() / TARGETS as f64, restarts as f64 / TARGETS as f64);
    println!("    {what} with a posture: {each:.1} us each, by {restarts:.1} restarts on average");
}

fn row(what: &str, mut run: impl FnMut()) {
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let start = Instant::now();
            run();
            1e6 * start.elapsed().as_secs_f64() / CONFIGURATIONS as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("    {what:<42} {:>9.3} us", times[ROUNDS / 2]);
}
