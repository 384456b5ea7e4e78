//! Checks by spheres beside VAMP's: `benches/spheres_vamp.py` says how. Takes FOLDER ROBOT KIND, reads what that wrote there,
//! and prints microseconds for a configuration and for a motion, free and blocked: the least of nine rounds, one thread.
//!
//! With URDDs instead (`cargo bench --bench spheres -- URDD...`), it prints what pieces behind spheres take: `in_collision` of
//! 3,000 random configurations by the pieces alone, by spheres around the pieces alone, and by the pieces
//! where the spheres are not free; in all configurations, and in those in which the robot is free.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

use std::time::Instant;

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use urdd_robot::spheres::{
    ApproximateAnswer, CoveringAnswer, LinkSpheres, Sphere, SphereChecker, SphereLevel,
};
use urdd_robot::{Obstacle, Queries, Robot, ShapeKind, World};

fn main() {
    let given: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    match &given[..] {
        [folder, robot, kind] if std::path::Path::new(folder).join("boxes.bin").exists() => {
            beside_vamp(folder, robot, kind);
        }
        urdds => urdds.iter().for_each(|urdd| screened(urdd)),
    }
}

fn numbers(path: &str) -> Vec<f64> {
    let bytes = std::fs::read(path).expect("a file");
    bytes
        .chunks(8)
        .map(|bytes| f64::from_le_bytes(bytes.try_into().expect("eight bytes")))
        .collect()
}

fn microseconds(asked: &[usize], ask: impl Fn(usize) -> bool) -> f64 {
    if asked.is_empty() {
        return 0.0;
    }
    let rounds = (20_000 / asked.len()).max(1);
    let round = || {
        let start = Instant::now();
        for one in (0..rounds).flat_map(|_| asked) {
            std::hint::black_box(ask(*one));
        }
        start.elapsed().as_secs_f64() / (rounds * asked.len()) as f64
    };
    1e6 * (0..9).map(|_| round()).fold(f64::INFINITY, f64::min)
}

fn beside_vamp(folder: &str, name: &str, kind: &str) {
    let robot = Robot::open(format!("{folder}/{name}")).expect("a URDD");
    let text = std::fs::read_to_string(format!("{folder}/{name}.json")).expect("a file");
    let data: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let list = |key: &str| data[key].as_array().expect("a list").clone();
    let links = list("links").into_iter().map(|link| {
        let spheres: Vec<[f64; 4]> = serde_json::from_value(link[1].clone()).expect("spheres");
        let sphere = |[x, y, z, radius]: [f64; 4]| Sphere { centre: [x, y, z], radius };
        LinkSpheres {
            link_idx: robot.link(link[0].as_str().expect("a name")).expect("a link"),
            spheres: spheres.into_iter().map(sphere).collect(),
        }
    });
    let links: Vec<LinkSpheres> = links.collect();
    let pairs: Vec<[usize; 2]> = serde_json::from_value(data["pairs"].clone()).expect("pairs");
    let pairs: Vec<[usize; 2]> =
        pairs.iter().map(|pair| pair.map(|at| links[at].link_idx)).collect();
    let level = SphereLevel { links, covers: false };
    let checker = SphereChecker::approximating(&robot, &[level], &pairs).expect("spheres");
    let checker = checker.around(&world(folder, name, kind)).expect("a world");

    let dofs = robot.dof_names().expect("DOFs");
    let place =
        |joint: &serde_json::Value| dofs.iter().position(|dof| Some(&**dof) == joint.as_str());
    let places: Vec<usize> =
        list("joints").iter().map(|joint| place(joint).expect("a DOF")).collect();
    let full = |row: &[f64]| {
        let mut q = vec![0.0; dofs.len()];
        places.iter().zip(row).for_each(|(place, value)| q[*place] = *value);
        q
    };
    let rows = |which: &str| -> Vec<Vec<f64>> {
        numbers(&format!("{folder}/{name}_{which}.bin")).chunks(places.len()).map(full).collect()
    };
    let (asked, ends) = (rows("q"), rows("e"));
    let touches = |k: usize| {
        checker.in_collision(&asked[k]).expect("an answer") == ApproximateAnswer::Contact
    };
    // As many configurations as VAMP checks.
    let steps = |k: usize| {
        let between = ends[2 * k].iter().zip(&ends[2 * k + 1]).map(|(a, b)| (b - a).powi(2));
        (between.sum::<f64>().sqrt() / 8.0 * 32.0 - 1e-6).ceil().max(1.0) as u64 * 8 - 1
    };
    let steps: Vec<u64> = (0..ends.len() / 2).map(steps).collect();
    let blocked = |k: usize| {
        let found = checker.blocked_in_steps(&ends[2 * k], &ends[2 * k + 1], steps[k]);
        found.expect("an answer").is_some()
    };
    let times = |count: usize, ask: &dyn Fn(usize) -> bool, which: &str| {
        let answers: Vec<bool> = (0..count).map(ask).collect();
        let of =
            |wanted: bool| -> Vec<usize> { (0..count).filter(|k| answers[*k] == wanted).collect() };
        let theirs = std::fs::read(format!("{folder}/{name}_{kind}_{which}.answers"));
        let theirs = theirs.expect("the answers of the other program");
        let differ = (0..count).filter(|k| answers[*k] != (theirs[*k] != 0)).collect::<Vec<_>>();
        (microseconds(&of(false), ask), microseconds(&of(true), ask), differ)
    };
    let (free, colliding, differ) = times(asked.len(), &touches, "q");
    let (open, closed, other) = times(steps.len(), &blocked, "e");
    println!(
        "spheres {name} {kind}: free {free:.3}, colliding {colliding:.3}; motions free {open:.3}, blocked {closed:.3}; \
         other answers: {} of {}, motions {} of {}",
        differ.len(),
        asked.len(),
        other.len(),
        steps.len(),
    );
    if kind.starts_with("points") {
        let cloud = numbers(&format!("{folder}/{kind}.bin"));
        let bare = differ.iter().filter(|k| nearest(&robot, &data, &asked[**k], &cloud) > 1e-5);
        println!("  without a contact among those, point by point in 64 bits: {}", bare.count());
    }
}

/// How far the spheres are from the points of a cloud, of 5 mm each, m: by each with each.
fn nearest(robot: &Robot, data: &serde_json::Value, q: &[f64], cloud: &[f64]) -> f64 {
    let poses = robot.link_poses(q).expect("poses");
    let mut least = f64::INFINITY;
    for link in data["links"].as_array().expect("a list") {
        let pose = poses[robot.link(link[0].as_str().expect("a name")).expect("a link")];
        let spheres: Vec<[f64; 4]> = serde_json::from_value(link[1].clone()).expect("spheres");
        for [x, y, z, radius] in spheres {
            let at = pose * nalgebra::Point3::new(x, y, z);
            for point in cloud.chunks(3) {
                let apart = (at - nalgebra::Point3::new(point[0], point[1], point[2])).norm();
                least = least.min(apart - radius - 0.005);
            }
        }
    }
    least
}

fn world(folder: &str, name: &str, kind: &str) -> World {
    let mut world = World::default();
    match kind {
        "self" => {}
        "boxes" => {
            for (k, b) in numbers(&format!("{folder}/boxes.bin")).chunks(9).enumerate() {
                let rotation = UnitQuaternion::from_euler_angles(b[3], b[4], b[5]);
                let pose = Isometry3::from_parts(Translation3::new(b[0], b[1], b[2]), rotation);
                let half = [b[6], b[7], b[8]];
                world.put(Obstacle::cuboid(&k.to_string(), pose, half).expect("a box"));
            }
        }
        kind => {
            let points = numbers(&format!("{folder}/{kind}.bin"));
            let points: Vec<[f64; 3]> = points.chunks(3).map(|p| [p[0], p[1], p[2]]).collect();
            let start = Instant::now();
            world.add_points("cloud", &points, 0.005).expect("points");
            let spent = 1e3 * start.elapsed().as_secs_f64();
            println!("spheres {name} {kind}: tree in {spent:.1} ms");
        }
    }
    world
}

fn screened(urdd: &str) {
    let robot = Robot::open(urdd).expect("a URDD");
    let space = robot.configurations().expect("configurations");
    let asked: Vec<Vec<f64>> = (0..3000).map(|k| space.random(k)).collect();
    let pieces = robot.proximity(ShapeKind::Pieces).expect("shapes");
    let levels = [pieces.bounding_level()];
    let spheres = SphereChecker::covering(&robot, &levels, &pieces.link_pairs()).expect("spheres");
    let maybe =
        |k: usize| spheres.in_collision(&asked[k]).expect("an answer") == CoveringAnswer::Maybe;
    let touches = |k: usize| pieces.in_collision(&asked[k]).expect("an answer");
    let all: Vec<usize> = (0..asked.len()).collect();
    let free: Vec<usize> = all.iter().copied().filter(|k| !touches(*k)).collect();
    for (what, some) in [("all", all), ("free", free)] {
        println!(
            "{urdd}, {what}: pieces {:.2}, spheres {:.2} ({:.0} % maybe), both {:.2} microseconds",
            microseconds(&some, touches),
            microseconds(&some, maybe),
            100.0 * some.iter().filter(|k| maybe(**k)).count() as f64 / some.len() as f64,
            microseconds(&some, |k| maybe(k) && touches(k)),
        );
    }
}
