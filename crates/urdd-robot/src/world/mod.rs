//! What stands around a robot, and how near its links are to it.
//!
//! A [`World`] is a list of [`Obstacle`]s: boxes, spheres, capsules, cylinders and meshes. [`Proximity::among`] prepares
//! a robot's shapes of one kind with a world; then [`Among`] answers as [`Proximity`] does. Skips do not count: every
//! shape of the robot is tested against every obstacle, but for links that the obstacle ignores.
//!
//! ```
//! use nalgebra::Isometry3;
//! use urdd_robot::{Obstacle, Robot, ShapeKind, World};
//!
//! # fn ask(urdd: &str) -> Result<(), urdd_robot::RobotError> {
//! let robot = Robot::open(urdd)?;
//! let table = Obstacle::cuboid("table", Isometry3::translation(0.0, 0.0, -0.05), [1.0, 1.0, 0.05])?;
//! let ball = Obstacle::sphere("ball", [0.4, 0.0, 0.3], 0.1)?;
//! let world = World::new([table.ignoring("base_link"), ball]);
//! let proximity = robot.proximity(ShapeKind::Pieces)?;
//! let among = proximity.among(&world)?;
//! let q = robot.configurations()?.zero();
//! if !among.in_collision(&q)? {
//!     let nearest = &among.nearest(&q, 1)?[0];
//!     println!("{} is {} m from {}", nearest.link, nearest.distance, nearest.obstacle);
//! }
//! # Ok(())
//! # }
//! ```
//!
//! Places are in the root link's frame, metres: to move the robot's base, move the world the other way.

mod among;
mod obstacle;

pub use among::{Among, ObstacleDistance};
pub use obstacle::{Obstacle, World};

#[cfg(doc)]
use super::Proximity;
