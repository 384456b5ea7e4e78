//! Time per query on a robot: poses, Jacobians, distances of all pairs, collision.
//!
//! `cargo bench --bench proximity -- URDD...` prints for each URDD and for hulls and pieces the median over five rounds
//! of the mean over 200 random configurations, in microseconds, on one thread and on two; and for parry the distances
//! of the same pairs. `benches/proximity_coal.py` does the same with Pinocchio and Coal. Without arguments it uses
//! `target/bench/welding_arm`, which it generates.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

use std::path::PathBuf;
use std::time::Instant;

use nalgebra::Isometry3;
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::ConvexPolyhedron;
use urdd_generate::{Settings, generate};
use urdd_robot::{Queries, Robot, ShapeKind, Solid};

const CONFIGURATIONS: u64 = 200;
const ROUNDS: usize = 5;

fn main() {
    let given: Vec<PathBuf> = std::env::args()
        .skip(1)
        .filter(|argument| !argument.starts_with("--"))
        .map(PathBuf::from)
        .collect();
    let given = match given.is_empty() {
        false => given,
        true => {
            let target = PathBuf::from("target/bench/welding_arm");
            let urdf = PathBuf::from("conformance/robots/welding_arm.urdf");
            generate(&urdf, &target, &Settings::default(), &()).expect("a URDD");
            vec![target]
        }
    };
    for path in given {
        measure(&path);
    }
}

fn measure(path: &std::path::Path) {
    let robot = Robot::open(path).expect("a URDD");
    let space = robot.configurations().expect("configurations");
    let all: Vec<Vec<f64>> = (0..CONFIGURATIONS).map(|k| space.random(k)).collect();
    let batch = all.concat();
    println!("{}", path.display());
    let mut poses = Vec::new();
    row("poses", || {
        for q in &all {
            robot.link_poses_into(q, &mut poses).expect("poses");
        }
    });
    let last = robot.link_names().expect("links").len() - 1;
    row("poses and the Jacobian of the last link", || {
        for q in &all {
            std::hint::black_box(robot.jacobian(q, last).expect("a Jacobian"));
        }
    });
    for kind in [ShapeKind::Hulls, ShapeKind::Pieces] {
        let start = Instant::now();
        let proximity = robot.proximity(kind).expect("shapes");
        println!(
            "  {kind}: {} shapes, {} pairs, prepared in {:.1} ms",
            proximity.num_shapes(),
            proximity.num_pairs(),
            1e3 * start.elapsed().as_secs_f64()
        );
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let pool = pool.expect("threads");
            pool.install(|| {
                row(&format!("distances, {threads} threads"), || {
                    proximity.distances_batch(&batch).expect("distances");
                });
                row(&format!("nearest pair, {threads} threads"), || {
                    proximity.min_distance_batch(&batch).expect("distances");
                });
                row(&format!("collision, {threads} threads"), || {
                    proximity.in_collision_batch(&batch).expect("answers");
                });
            });
        }
        row("distances with points, one by one", || {
            for q in &all {
                std::hint::black_box(proximity.closest_points(q).expect("distances"));
            }
        });
        parry(&robot, kind, &all[..20]);
    }
}

fn parry(robot: &Robot, kind: ShapeKind, all: &[Vec<f64>]) {
    let shapes: Vec<(usize, ConvexPolyhedron)> = robot
        .shapes(kind)
        .expect("shapes")
        .into_iter()
        .map(|shape| {
            let Solid::Mesh(mesh) = shape.solid else {
                panic!("a mesh");
            };
            let points = mesh.vertices.iter().map(|[x, y, z]| Vector::new(*x, *y, *z));
            let points: Vec<Vector> = points.collect();
            (shape.link, ConvexPolyhedron::from_convex_hull(&points).expect("a hull"))
        })
        .collect();
    let skips = robot.skips(kind).expect("skips");
    let poses: Vec<Vec<Pose>> = all
        .iter()
        .map(|q| robot.link_poses(q).expect("poses").iter().map(pose).collect())
        .collect();
    let times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let start = Instant::now();
            let mut sum = 0.0;
            for poses in &poses {
                for (i, (a, first)) in shapes.iter().enumerate() {
                    for (j, (b, second)) in shapes.iter().enumerate().skip(i + 1) {
                        if !skips.is_skipped(i, j) {
                            let found = query::distance(&poses[*a], first, &poses[*b], second);
                            sum += found.expect("a distance").distance;
                        }
                    }
                }
            }
            std::hint::black_box(sum);
            1e6 * start.elapsed().as_secs_f64() / poses.len() as f64
        })
        .collect();
    println!("    {:<42} {:>9.2} us", "distances by parry, 1 thread", median(times));
}

fn pose(pose: &Isometry3<f64>) -> Pose {
    let vector = |v: nalgebra::Vector3<f64>| Vector::new(v.x, v.y, v.z);
    Pose::new(vector(pose.translation.vector), vector(pose.rotation.scaled_axis()))
}

fn row(what: &str, mut run: impl FnMut()) {
    let times = (0..ROUNDS)
        .map(|_| {
            let start = Instant::now();
            run();
            1e6 * start.elapsed().as_secs_f64() / CONFIGURATIONS as f64
        })
        .collect();
    println!("    {what:<42} {:>9.2} us", median(times));
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
