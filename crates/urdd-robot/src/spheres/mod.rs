//! Spheres in the place of a robot's shapes: yes or no in a fraction of a microsecond.
//!
//! A planner asks millions of times whether a configuration or a straight motion is free. [`SphereChecker`] answers from
//! spheres of the links alone, eight configurations at once, by the vector instructions that the processor has. Nothing is
//! generated or compiled for a robot: its joints become a list of steps when the checker is made.
//!
//! Spheres come in levels ([`SphereLevel`]) from coarse to fine, each inside the coarser one. A pair of links goes to a finer
//! level only where the coarser ones touch, and the finest decides. If level 0 has one sphere for each link, it is what is
//! around the others; it is enlarged where it is not, and made where it is missing.
//!
//! **What an answer is worth** is in its type. [`Covering`] spheres contain the shapes: [`CoveringAnswer::Free`] is certain,
//! and where spheres touch, the answer is [`CoveringAnswer::Maybe`]. [`Approximating`] spheres are only near the shapes.
//!
//! **Accuracy.** Angles are reduced in 64 bits; all else is computed in 32 bits. A sine or a cosine is wrong by at most 2e-7.
//! For covering spheres, the errors of sines, cosines, rotations and positions are added up along the joints, and the radii
//! grow by the sum: a few micrometres for an arm, 1e-6 of the distance from the root for a robot that has moved far away. The
//! margin of a query grows by a millionth. Obstacles add 2e-6 of their size and their distance. So a free answer is certain,
//! and spheres that are farther apart than that are free. Answers are the same on each instruction set of an architecture,
//! for any number of threads, and alone as in a batch.
//!
//! Obstacles are what a [`World`](crate::World) has: boxes, spheres, capsules and cylinders exactly, hulls and the pieces of
//! meshes by their exact distances, clouds of points and fields of heights by a tree.
//!
//! ```
//! use urdd_robot::spheres::{CoveringAnswer, SphereChecker};
//! use urdd_robot::{EdgeSettings, Obstacle, Robot, ShapeKind, World};
//!
//! # let folder = tempfile::tempdir()?;
//! # let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/../../conformance/robots/gripper.urdf");
//! # let path = folder.path().join("gripper");
//! # urdd_generate::generate(urdf.as_ref(), &path, &Default::default(), &())?;
//! let robot = Robot::open(&path)?;
//! let pieces = robot.proximity(ShapeKind::Pieces)?;
//! // One sphere around each piece covers the pieces.
//! let levels = [pieces.bounding_level()];
//! let checker = SphereChecker::covering(&robot, &levels, &pieces.link_pairs())?;
//! let mut world = World::default();
//! world.add_points("seen", &[[3.0, 0.0, 0.5], [3.0, 0.1, 0.5]], 0.01)?;
//! let checker = checker.around(&world)?;
//! let [start, end] = [robot.configurations()?.lower(), robot.configurations()?.upper()];
//! if checker.in_collision(&start)? == CoveringAnswer::Free {
//!     println!("blocked at {:?}", checker.blocked_edge(&start, &end, &EdgeSettings::default())?);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod block;
mod checker;
mod level;
mod model;
mod obstacles;
mod placed;
mod tape;

pub use checker::SphereChecker;
pub use level::{
    ApproximateAnswer, Approximating, Coverage, Covering, CoveringAnswer, LinkSpheres, Sphere,
    SphereLevel,
};
