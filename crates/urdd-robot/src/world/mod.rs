//! Obstacles around a robot, and its distances to them.
//!
//! A [`World`] is a list of [`Obstacle`]s: boxes, spheres, capsules, cylinders and meshes.
//! [`Proximity::world_proximity`] combines a robot's shapes of one kind with a world. [`WorldProximity`] then has the
//! queries of [`Proximity`]. Skips do not apply: every shape of the robot is tested against every obstacle,
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
//!
//! Obstacles that move only move: [`Obstacle::at`] and [`WorldProximity::move_obstacles`] prepare nothing again, and the
//! latter does not allocate. A control loop, with `poses` from a tracker:
//!
//! ```
//! # use nalgebra::Isometry3;
//! # use urdd_robot::{Proximity, RobotError, World, Workspace};
//! # fn cycle(proximity: &Proximity, world: &World, q: &[f64], poses: &[Isometry3<f64>]) -> Result<(), RobotError> {
//! let mut around = proximity.world_proximity(world)?;
//! let mut workspace = Workspace::default();
//! // In each cycle:
//! around.move_obstacles(0, poses)?;
//! let distance = around.min_distance_with(q, &mut workspace)?;
//! # Ok(())
//! # }
//! ```

mod proximity;

pub use proximity::{ObstacleDistance, ObstacleGradient, WorldProximity};

#[cfg(doc)]
use super::{Obstacle, Proximity, World};
