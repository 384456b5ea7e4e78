//! Obstacles.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3};

use crate::error::RobotError;
use urdd_geometry::Mesh;
use urdd_geometry::bounding_sphere::about;
use urdd_geometry::convex::{ConvexShape, ShapeError};
use urdd_geometry::decompose::{self, decompose};
use urdd_geometry::oriented_box::corners;

/// Sides of the prism that approximates a cylinder.
const SIDES: u32 = 64;

/// A body that a robot must not touch.
#[derive(Debug, Clone)]
pub struct Obstacle {
    pub(super) name: Arc<str>,
    pub(super) parts: Vec<Part>,
    /// Names of links that may touch it.
    pub(super) ignored: Vec<String>,
}

/// A convex shape swept by a sphere: all points within `radius` of the shape, in the root link's frame.
#[derive(Debug, Clone)]
pub(super) struct Part {
    pub shape: ConvexShape,
    pub radius: f64,
    /// Distance from the centre of the shape to its farthest point, in metres, without `radius`.
    pub reach: f64,
}

/// The obstacles around a robot.
#[derive(Debug, Clone, Default)]
pub struct World {
    pub(super) obstacles: Vec<Obstacle>,
}

impl World {
    /// Creates a world from obstacles.
    pub fn new(obstacles: impl IntoIterator<Item = Obstacle>) -> Self {
        Self {
            obstacles: obstacles.into_iter().collect(),
        }
    }

    /// The obstacles.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }
}

impl Obstacle {
    /// A box: the pose of its centre and axes, and its half extents, in metres.
    ///
    /// # Errors
    /// [`RobotError::Obstacle`] if a size is not finite, negative or larger than 1e9 m, or if a corner or point in the
    /// root link's frame is not finite or too far away.
    pub fn cuboid(
        name: &str,
        pose: Isometry3<f64>,
        half_extents: [f64; 3],
    ) -> Result<Self, RobotError> {
        for size in half_extents {
            check_size(name, size)?;
        }
        Self::swept(name, &pose, &corners(half_extents), 0.0)
    }

    /// A sphere: its centre and radius, in metres.
    ///
    /// # Errors
    /// As [`Obstacle::cuboid`].
    pub fn sphere(name: &str, centre: [f64; 3], radius: f64) -> Result<Self, RobotError> {
        Self::swept(name, &Isometry3::identity(), &[centre], radius)
    }

    /// A capsule: all points within `radius` of a segment along the z axis of its frame, from `-half_length` to
    /// `half_length`.
    ///
    /// # Errors
    /// As [`Obstacle::cuboid`].
    pub fn capsule(
        name: &str,
        pose: Isometry3<f64>,
        radius: f64,
        half_length: f64,
    ) -> Result<Self, RobotError> {
        check_size(name, half_length)?;
        let ends = [-half_length, half_length].map(|z| [0.0, 0.0, z]);
        Self::swept(name, &pose, &ends, radius)
    }

    /// A cylinder along the z axis of its frame, from `-half_length` to `half_length`. It is approximated by a
    /// circumscribed prism with 64 sides, which exceeds the radius by up to 0.13 %.
    ///
    /// # Errors
    /// As [`Obstacle::cuboid`].
    pub fn cylinder(
        name: &str,
        pose: Isometry3<f64>,
        radius: f64,
        half_length: f64,
    ) -> Result<Self, RobotError> {
        check_size(name, radius)?;
        check_size(name, half_length)?;
        let outer = radius / (std::f64::consts::PI / f64::from(SIDES)).cos();
        let corner = |k: u32| {
            let angle = std::f64::consts::TAU * f64::from(k % SIDES) / f64::from(SIDES);
            let z = if k < SIDES { -half_length } else { half_length };
            [outer * angle.cos(), outer * angle.sin(), z]
        };
        let corners: Vec<[f64; 3]> = (0..2 * SIDES).map(corner).collect();
        Self::swept(name, &pose, &corners, 0.0)
    }

    /// The convex hull of points, in metres.
    ///
    /// # Errors
    /// As [`Obstacle::cuboid`], and if there are no points.
    pub fn hull(name: &str, pose: Isometry3<f64>, points: &[[f64; 3]]) -> Result<Self, RobotError> {
        Self::swept(name, &pose, points, 0.0)
    }

    /// A mesh, decomposed into convex pieces as `urdd generate` does for links, at the same cost. Cavities remain as
    /// far as the decomposition preserves them. [`Obstacle::hull`] is fast, and fills cavities.
    ///
    /// # Errors
    /// As [`Obstacle::hull`].
    pub fn mesh(name: &str, pose: Isometry3<f64>, mesh: &Mesh) -> Result<Self, RobotError> {
        // Checks the limits of the points before the decomposition.
        let mut whole = Self::hull(name, pose, &mesh.vertices)?;
        let pieces = decompose(mesh, &decompose::Settings::default()).pieces;
        if pieces.is_empty() {
            return Ok(whole);
        }
        let parts = pieces.iter().map(|piece| part(&pose, &piece.vertices, 0.0));
        let parts: Result<Vec<Part>, ShapeError> = parts.collect();
        whole.parts = parts.map_err(|error| fault(name, &error.to_string()))?;
        Ok(whole)
    }

    /// Excludes a link from the tests against this obstacle, such as the base mounted on it or the gripper that holds
    /// it. [`Proximity::world_proximity`](crate::Proximity::world_proximity) rejects an unknown link.
    pub fn ignoring(mut self, link: &str) -> Self {
        self.ignored.push(link.to_owned());
        self
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of its convex parts.
    pub fn num_parts(&self) -> usize {
        self.parts.len()
    }

    fn swept(
        name: &str,
        pose: &Isometry3<f64>,
        points: &[[f64; 3]],
        radius: f64,
    ) -> Result<Self, RobotError> {
        check_size(name, radius)?;
        let part = part(pose, points, radius).map_err(|error| fault(name, &error.to_string()))?;
        Ok(Self {
            name: Arc::from(name),
            parts: vec![part],
            ignored: Vec::new(),
        })
    }
}

fn part(pose: &Isometry3<f64>, points: &[[f64; 3]], radius: f64) -> Result<Part, ShapeError> {
    let placed = points
        .iter()
        .map(|p| (pose * Point3::from(*p)).coords.into());
    let placed: Vec<[f64; 3]> = placed.collect();
    let shape = ConvexShape::of_points(&placed)?;
    Ok(Part {
        reach: about(shape.centre(), &placed).radius,
        shape,
        radius,
    })
}

fn check_size(name: &str, size: f64) -> Result<(), RobotError> {
    match (0.0..=1e9).contains(&size) {
        true => Ok(()),
        false => Err(fault(name, &ShapeError::Size { size }.to_string())),
    }
}

fn fault(name: &str, reason: &str) -> RobotError {
    RobotError::Obstacle {
        name: name.to_owned(),
        reason: reason.to_owned(),
    }
}
