//! Obstacles that move: what `Obstacle::at` takes, and a control loop at 1 kHz among 20 moving boxes.
//!
//! `cargo bench --bench moving -- URDD...` prints for each URDD the median, the 99th percentile and the longest cycle of
//! 5,000, in microseconds, and the allocations after the first hundred. A cycle moves all boxes and asks for the distance
//! to them, the nearest five pairs with their gradients, and whether the robot touches itself. Without arguments it uses
//! `target/bench/welding_arm`, which it generates.

// A bench may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use urdd_generate::{Settings, generate};
use urdd_geometry::Mesh;
use urdd_robot::{Obstacle, Queries, Robot, ShapeKind, World};

static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

struct Counting;

// SAFETY: the system's allocator, counted.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: guaranteed by the caller.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: guaranteed by the caller.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const BOXES: usize = 20;
const CYCLES: usize = 5_000;
const FIRST: usize = 100;

fn main() {
    let given = std::env::args().skip(1).filter(|argument| !argument.starts_with("--"));
    let mut given: Vec<PathBuf> = given.map(PathBuf::from).collect();
    if given.is_empty() {
        let target = PathBuf::from("target/bench/welding_arm");
        let urdf = PathBuf::from("conformance/robots/welding_arm.urdf");
        generate(&urdf, &target, &Settings::default(), &()).expect("a URDD");
        given.push(target);
    }
    moves();
    given.iter().for_each(|path| control(path));
}

/// A pose that changes with time, s.
fn pose(k: usize, time: f64) -> Isometry3<f64> {
    let phase = time + k as f64;
    let place = Translation3::new(0.9 * phase.cos(), 0.9 * phase.sin(), 0.05 * k as f64);
    Isometry3::from_parts(place, UnitQuaternion::from_euler_angles(0.3 * phase, phase, 0.7 * phase))
}

/// A ball of 3,200 triangles.
fn ball() -> Mesh {
    let mut mesh = Mesh::default();
    let (rings, sides) = (41u32, 40u32);
    for k in 0..rings * sides {
        let (ring, side) = (k / sides, k % sides);
        let polar = std::f64::consts::PI * (f64::from(ring) + 0.5) / f64::from(rings);
        let around = std::f64::consts::TAU * f64::from(side) / f64::from(sides);
        let (sine, cosine) = polar.sin_cos();
        mesh.vertices.push([sine * around.cos(), sine * around.sin(), cosine].map(|x| 0.1 * x));
        if ring + 1 < rings {
            let [next, above] = [ring * sides + (side + 1) % sides, k + sides];
            mesh.triangles.push([k, next, above]);
            mesh.triangles.push([next, next + sides, above]);
        }
    }
    mesh
}

fn moves() {
    let here = Isometry3::identity();
    let mesh = ball();
    for (name, one) in [
        ("box", Obstacle::cuboid("o", here, [0.1, 0.1, 0.1])),
        ("cylinder", Obstacle::cylinder("o", here, 0.1, 0.1)),
        ("hull of 1,640 points", Obstacle::hull("o", here, &mesh.vertices)),
        ("mesh of 3,200 triangles", Obstacle::mesh("o", here, &mesh)),
    ] {
        let one = one.expect("an obstacle");
        let began = Instant::now();
        for k in 0..1000 {
            std::hint::black_box(one.at(pose(k, 0.0)).expect("moved"));
        }
        println!("at, {name:24} {:9.3} us", 1e3 * began.elapsed().as_secs_f64());
    }
}

fn control(path: &std::path::Path) {
    let robot = Robot::open(path).expect("a URDD");
    let proximity = robot.proximity(ShapeKind::Pieces).expect("shapes");
    let boxes = (0..BOXES).map(|k| Obstacle::cuboid("box", pose(k, 0.0), [0.05, 0.05, 0.05]));
    let world = World::new(boxes.map(|one| one.expect("a box")));
    let mut around = proximity.world_proximity(&world).expect("a world");
    let space = robot.configurations().expect("configurations");
    let (start, end) = (space.random(1), space.random(2));
    let (mut q, mut poses) = (start.clone(), [here(); BOXES]);
    let (mut times, mut before) = (vec![Duration::ZERO; CYCLES], 0);
    let began = Instant::now();
    for (cycle, taken) in times.iter_mut().enumerate() {
        let time = 1e-3 * cycle as f64;
        while began.elapsed().as_secs_f64() < time {
            std::thread::sleep(Duration::from_micros(50));
        }
        if cycle == FIRST {
            before = ALLOCATIONS.load(Ordering::Relaxed);
        }
        let now = Instant::now();
        for ((value, from), to) in q.iter_mut().zip(&start).zip(&end) {
            *value = from + 0.5 * (1.0 - time.cos()) * (to - from);
        }
        for (k, place) in poses.iter_mut().enumerate() {
            *place = pose(k, time);
        }
        around.move_obstacles(0, &poses).expect("moved");
        let mut least = around.min_distance(&q).expect("a distance");
        let nearest = around.each_gradient(&q, 5, |pair, gradient| {
            least = least.map(|least| least.min(pair.distance));
            std::hint::black_box(gradient);
        });
        nearest.expect("pairs");
        let touches = proximity.in_collision(&q).expect("an answer");
        std::hint::black_box((least, touches));
        *taken = now.elapsed();
    }
    let allocations = ALLOCATIONS.load(Ordering::Relaxed) - before;
    times.sort_unstable();
    let [median, most, last] = [CYCLES / 2, CYCLES * 99 / 100, CYCLES - 1].map(|k| times[k]);
    println!(
        "{}, {} pairs with parts: median {median:.1?}, 99th percentile {most:.1?}, longest {last:.1?}, {allocations} \
         allocations in {} cycles",
        path.display(),
        around.num_pairs_of_parts(),
        CYCLES - FIRST
    );
}

fn here() -> Isometry3<f64> {
    Isometry3::identity()
}
