//! Obstacles around a robot, and its distances to them.
//!
//! A [`World`] is a list of [`Obstacle`]s: boxes, spheres, capsules, cylinders and meshes.
//! [`Proximity::world_proximity`] combines a robot's shapes of one kind with a world. [`WorldProximity`] then offers
//! queries like those of [`Proximity`]. Skips do not apply: every shape of the robot is tested against every obstacle,
//! except for links that the obstacle ignores.
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
//! let proximity = proximity.world_proximity(&world)?;
//! let q = robot.configurations()?.zero();
//! if !proximity.in_collision(&q)? {
//!     let nearest = &proximity.nearest(&q, 1)?[0];
//!     println!("{} is {} m from {}", nearest.link, nearest.distance, nearest.obstacle);
//! }
//! # Ok(())
//! # }
//! ```
//!
//! Positions are in the root link's frame, in metres. To move the robot's base, apply the inverse motion to the world.

mod edges;
mod gradient;
mod proximity;

pub use gradient::ObstacleGradient;
pub use proximity::{ObstacleDistance, WorldProximity};

#[cfg(doc)]
use super::{Obstacle, Proximity, World};
