//! Error rates of a self-collision model, overall and near contact, and its time compared with exact queries.
//!
//! `cargo bench --bench learned -- URDD...` prints a JSON object for each URDD with a model, as in `docs/learned.md`.
//! Counts are over 200,000 sampled configurations that were not used for training. Times are microseconds of
//! processor time per configuration on one thread, the minimum of nine rounds. Without arguments, it trains a model of
//! `conformance/robots/welding_arm.urdf`. `benches/evaluation/learned.py` trains the models and runs it.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use nalgebra::Isometry3;
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::ConvexPolyhedron;
use rayon::prelude::*;
use serde_json::{Value, json};
use urdd_format::rate::Rate;
use urdd_generate::{Selection, Settings, generate};
use urdd_robot::{
    CollisionModel, Configurations, Obstacle, Proximity, Queries, Robot, ShapeKind, Solid, World,
};

/// The first counted configuration, and their number.
const FIRST: u64 = 10_000_000;
const COUNT: u64 = 200_000;
/// The timed configurations.
const TIMED: usize = 10_000;
const ROUNDS: usize = 9;
/// Maximum motion of a DOF between a colliding configuration and its free neighbour, rad or m.
const NEAR: f64 = 0.05;
/// Bisection ends when no DOF moves farther than this, rad or m.
const AT_CONTACT: f64 = 1e-4;

fn main() {
    let given: Vec<PathBuf> = std::env::args()
        .skip(1)
        .filter(|argument| !argument.starts_with("--"))
        .map(PathBuf::from)
        .collect();
    let paths = match given.is_empty() {
        false => given,
        true => vec![made()],
    };
    for path in paths {
        let found = measure(&path);
        println!("{}", serde_json::to_string(&found).expect("JSON"));
    }
}

fn made() -> PathBuf {
    let target = PathBuf::from("target/bench/welding_arm_with_model");
    let settings = Settings {
        selection: Selection::parse(["all", "self_collision_model"]).expect("modules"),
        ..Settings::default()
    };
    let urdf = PathBuf::from("conformance/robots/welding_arm.urdf");
    generate(&urdf, &target, &settings, &()).expect("a URDD");
    target
}

/// A robot, its model, and its exact shapes.
struct Subject {
    robot: Robot,
    space: Configurations,
    model: CollisionModel,
    pieces: Proximity,
}

/// A colliding configuration, and whether the model clears it.
struct Collision {
    q: Vec<f64>,
    missed: bool,
}

fn measure(path: &Path) -> Value {
    let robot = Robot::open(path).expect("a URDD");
    let subject = Subject {
        space: robot.configurations().expect("configurations").clone(),
        model: robot.collision_model().expect("a model"),
        pieces: robot.proximity(ShapeKind::Pieces).expect("pieces"),
        robot,
    };
    let name = path.file_name().map(|name| name.to_string_lossy());
    json!({
        "urdd": name,
        "counts": subject.count(),
        "times": subject.times(),
        "obstacles": subject.among_obstacles(),
    })
}

fn rate(found: impl Iterator<Item = bool>) -> Rate {
    let (mut count, mut of) = (0, 0);
    for found in found {
        count += u32::from(found);
        of += 1;
    }
    Rate::new(count, of)
}

impl Subject {
    fn collides(&self, q: &[f64]) -> bool {
        self.pieces.in_collision(q).expect("an answer")
    }

    fn clears(&self, q: &[f64]) -> bool {
        !self.model.may_collide(q).expect("an answer")
    }

    /// Rates over all configurations, near contact, and at contact; penetration depths of the misses.
    fn count(&self) -> Value {
        let sampled = |k: u64| self.space.random(FIRST + k);
        let all: Vec<(bool, bool)> = (0..COUNT)
            .into_par_iter()
            .map(|k| {
                let q = sampled(k);
                (self.collides(&q), self.clears(&q))
            })
            .collect();
        let free: Vec<u64> = (0..COUNT).filter(|k| !all[*k as usize].0).collect();
        let collisions: Vec<(u64, Collision)> = (0..COUNT)
            .filter(|k| all[*k as usize].0)
            .map(|k| {
                let (q, missed) = (sampled(k), all[k as usize].1);
                (k, Collision { q, missed })
            })
            .collect();
        let near = |towards: &(dyn Fn(u64, &[f64]) -> Vec<f64> + Sync)| {
            let near = collisions.par_iter();
            let near = near.filter(|(k, of)| !self.collides(&towards(*k, &of.q)));
            let near: Vec<&Collision> = near.map(|(_, of)| of).collect();
            let depths = near.iter().filter(|of| of.missed).map(|of| self.depth(&of.q));
            let depths: Vec<f64> = depths.collect();
            json!({ "misses": rate(near.iter().map(|of| of.missed)), "depth": spread(depths) })
        };
        // As SPEC 8.8.10 defines it, and by noise in each DOF.
        let next = |k: u64, q: &[f64]| stepped(q, &sampled(k + 1));
        let noise = |k: u64, q: &[f64]| {
            let drawn = self.space.random(FIRST + COUNT + k);
            let bounds = self.space.bounds().iter();
            let moved = q.iter().zip(drawn).zip(bounds).map(|((q, drawn), [lower, upper])| {
                let part = (drawn - lower) / (upper - lower).max(f64::MIN_POSITIVE);
                (q + NEAR * (2.0 * part - 1.0)).clamp(*lower, *upper)
            });
            moved.collect()
        };
        let at_contact: Vec<Collision> = collisions
            .par_iter()
            .enumerate()
            .map(|(place, (_, of))| {
                let q = self.bisect(&of.q, &sampled(free[place % free.len()]));
                let missed = self.clears(&q);
                Collision { q, missed }
            })
            .collect();
        let missed = collisions.par_iter().filter(|(_, of)| of.missed);
        let depths: Vec<f64> = missed.map(|(_, of)| self.depth(&of.q)).collect();
        json!({
            "configurations": COUNT,
            "misses": rate(collisions.iter().map(|(_, of)| of.missed)),
            "clears": rate(free.iter().map(|k| all[*k as usize].1)),
            "depth": spread(depths),
            "near_by_step": near(&next),
            "near_by_noise": near(&noise),
            "at_contact": rate(at_contact.iter().map(|of| of.missed)),
        })
    }

    /// The colliding end of a line to a free configuration, bisected until it is short.
    fn bisect(&self, colliding: &[f64], free: &[f64]) -> Vec<f64> {
        let (mut colliding, mut free) = (colliding.to_vec(), free.to_vec());
        loop {
            let apart = colliding.iter().zip(&free).map(|(a, b)| (a - b).abs());
            if apart.fold(0.0, f64::max) < AT_CONTACT {
                return colliding;
            }
            let middle = colliding.iter().zip(&free).map(|(a, b)| 0.5 * (a + b));
            let middle: Vec<f64> = middle.collect();
            match self.collides(&middle) {
                true => colliding = middle,
                false => free = middle,
            }
        }
    }

    /// The greatest penetration depth of two pieces, by parry: the shortest way apart, metres.
    fn depth(&self, q: &[f64]) -> f64 {
        thread_local! {
            static SHAPES: std::cell::RefCell<HashMap<String, Shapes>> = Default::default();
        }
        let poses = self.robot.link_poses(q).expect("poses");
        SHAPES.with_borrow_mut(|known| {
            let shapes = known.entry(self.robot.folder_name()).or_insert_with(|| self.shapes());
            let touching = self.pieces.collisions(q).expect("pairs");
            let depths = touching.iter().map(|pair| {
                let [a, b] = [0, 1].map(|k| {
                    let shape = &shapes[&(pair.link_idxs[k], pair.pieces[k])];
                    (shape, placed(&poses[pair.link_idxs[k]]))
                });
                let contact = query::contact(&a.1, a.0, &b.1, b.0, 0.0).expect("supported shapes");
                contact.map_or(0.0, |contact| -contact.dist)
            });
            depths.fold(0.0, f64::max)
        })
    }

    fn shapes(&self) -> Shapes {
        let pieces = self.robot.shapes(ShapeKind::Pieces).expect("pieces");
        let shape = pieces.into_iter().filter_map(|piece| {
            let Solid::Mesh(mesh) = piece.solid else {
                return None;
            };
            let points = mesh.vertices.iter();
            let points: Vec<Vector> = points.map(|[x, y, z]| Vector::new(*x, *y, *z)).collect();
            Some(((piece.link, piece.piece), ConvexPolyhedron::from_convex_hull(&points)?))
        });
        shape.collect()
    }

    /// Microseconds per configuration, in batches of several sizes.
    fn times(&self) -> Value {
        let all: Vec<f64> = (0..TIMED as u64).flat_map(|k| self.space.random(FIRST + k)).collect();
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let one = one.expect("a thread");
        let row = |batch: usize| {
            one.install(|| {
                json!({
                    "batch": batch,
                    "model": self.per_configuration(&all, batch, &|q| self.by_model(q)),
                    "distances": self.per_configuration(&all[..all.len() / 10], batch, &|q| {
                        self.pieces.distances_batch(q).expect("distances");
                    }),
                    "exact": self.per_configuration(&all, batch, &|q| self.exactly(q)),
                    "both": self.per_configuration(&all, batch, &|q| {
                        let rest = self.not_cleared(q);
                        self.exactly(&rest);
                    }),
                })
            })
        };
        Value::Array([1, 10, 100, TIMED].map(row).to_vec())
    }

    fn by_model(&self, configurations: &[f64]) {
        self.model.may_collide_batch(configurations).expect("answers");
    }

    fn exactly(&self, configurations: &[f64]) {
        self.pieces.in_collision_batch(configurations).expect("answers");
    }

    /// The configurations that the model does not clear.
    fn not_cleared(&self, configurations: &[f64]) -> Vec<f64> {
        let may = self.model.may_collide_batch(configurations).expect("answers");
        let rows = configurations.chunks(self.model.num_dofs()).zip(&may);
        rows.filter(|(_, may)| **may).flat_map(|(q, _)| q.to_vec()).collect()
    }

    fn per_configuration(&self, all: &[f64], batch: usize, work: &dyn Fn(&[f64])) -> f64 {
        let count = all.len() / self.model.num_dofs();
        let round = || {
            let start = processor_time();
            all.chunks(batch * self.model.num_dofs()).for_each(work);
            1e6 * (processor_time() - start) / count as f64
        };
        (0..ROUNDS).map(|_| round()).fold(f64::INFINITY, f64::min)
    }

    /// A table below the robot and a pillar beside it, which the model does not know, and the time that the model saves
    /// there.
    fn among_obstacles(&self) -> Value {
        let table = Isometry3::translation(0.0, 0.0, -0.06);
        let pillar = Isometry3::translation(0.4, 0.0, 0.4);
        let world = World::new([
            Obstacle::cuboid("table", table, [1.0, 1.0, 0.05]).expect("a box"),
            Obstacle::cuboid("pillar", pillar, [0.05, 0.05, 0.4]).expect("a box"),
        ]);
        let among = self.pieces.world_proximity(&world).expect("a world");
        let hits = |q: &[f64]| among.in_collision(q).expect("an answer");
        let cleared = (0..TIMED as u64).map(|k| self.space.random(FIRST + k));
        let cleared = cleared.filter(|q| self.clears(q)).map(|q| hits(&q));
        let cleared = rate(cleared);
        let all: Vec<f64> = (0..TIMED as u64).flat_map(|k| self.space.random(FIRST + k)).collect();
        let time = |work: &dyn Fn(&[f64])| self.per_configuration(&all, 1, work);
        json!({
            "cleared_that_hit": cleared,
            "exact": time(&|q| {
                let _ = self.collides(q) || hits(q);
            }),
            "both": time(&|q| {
                let _ = (!self.clears(q) && self.collides(q)) || hits(q);
            }),
        })
    }
}

/// The processor time of this process so far, seconds: what other programs do meanwhile does not count. Linux only.
fn processor_time() -> f64 {
    const CLOCK_PROCESS_CPUTIME_ID: i32 = 2;
    unsafe extern "C" {
        fn clock_gettime(clock: i32, time: *mut [i64; 2]) -> i32;
    }
    let mut time = [0; 2];
    // SAFETY: the function of every C library; on 64 bits, it writes seconds and nanoseconds.
    assert_eq!(unsafe { clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &mut time) }, 0);
    time[0] as f64 + 1e-9 * time[1] as f64
}

type Shapes = HashMap<(usize, usize), ConvexPolyhedron>;

fn placed(pose: &Isometry3<f64>) -> Pose {
    let vector = |v: nalgebra::Vector3<f64>| Vector::new(v.x, v.y, v.z);
    Pose::new(vector(pose.translation.vector), vector(pose.rotation.scaled_axis()))
}

/// A step towards another configuration, as SPEC 8.8.10 defines it.
fn stepped(from: &[f64], to: &[f64]) -> Vec<f64> {
    let apart = from.iter().zip(to).map(|(a, b)| (b - a).abs());
    let part = (NEAR / apart.fold(f64::MIN_POSITIVE, f64::max)).min(1.0);
    let steps = from.iter().zip(to).map(|(a, b)| a + part * (b - a));
    steps.collect()
}

/// The median and the largest of some depths, millimetres.
fn spread(mut depths: Vec<f64>) -> Value {
    depths.sort_by(f64::total_cmp);
    let median = depths.get(depths.len() / 2).map(|depth| 1e3 * depth);
    json!({ "median_mm": median, "largest_mm": depths.last().map(|depth| 1e3 * depth) })
}
