//! Bodies that a robot must not touch, or that its links carry.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Translation3};

use crate::error::RobotError;
use urdd_geometry::Mesh;
use urdd_geometry::bounding_sphere::{BoundingSphere, about};
use urdd_geometry::convex::{ConvexShape, ShapeError};
use urdd_geometry::decompose::{self, decompose};
use urdd_geometry::oriented_box::corners;
use urdd_geometry::vector::norm;

/// Sides of the prism that approximates a cylinder.
const SIDES: u32 = 64;

/// A body that a robot must not touch, or that a link carries: [`Proximity::attach`](crate::Proximity::attach). Clones
/// share its shapes.
#[derive(Debug, Clone)]
pub struct Obstacle {
    pub(crate) name: Arc<str>,
    pub(crate) parts: Vec<Part>,
    /// Names of links that may touch it.
    pub(crate) ignored: Vec<String>,
}

/// A convex shape swept by a sphere: all points within `radius` of the shape, in the root link's frame.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    pub core: Arc<ConvexShape>,
    pub radius: f64,
    /// The points of the shape in the frame of the obstacle.
    own: Arc<[[f64; 3]]>,
    /// The least and the largest coordinates of the shape, in metres, without `radius`.
    bounds: [[f64; 3]; 2],
    /// Of the shape, with `radius`.
    pub sphere: BoundingSphere,
}

impl Part {
    /// A lower bound of the distance of the part from a sphere, in metres; not positive if they may touch.
    pub fn bound(&self, sphere: &BoundingSphere) -> f64 {
        let [least, most] = self.bounds;
        let p = sphere.centre;
        let apart = [0, 1, 2].map(|k| (least[k] - p[k]).max(p[k] - most[k]).max(0.0));
        // Less by more than any rounding error.
        norm(apart) * (1.0 - 1e-12) - sphere.radius - self.radius
    }
}

/// The obstacles around a robot.
#[derive(Debug, Clone, Default)]
pub struct World {
    pub(crate) obstacles: Vec<Obstacle>,
}

impl World {
    /// Creates a world from obstacles.
    pub fn new(obstacles: impl IntoIterator<Item = Obstacle>) -> Self {
        Self { obstacles: obstacles.into_iter().collect() }
    }

    /// The obstacles.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    /// Adds an obstacle, or replaces the first one of its name: one that came, or [moved](Obstacle::at). The others, and
    /// the robot's shapes, are not prepared again by [`Proximity::world_proximity`](crate::Proximity::world_proximity).
    pub fn put(&mut self, obstacle: Obstacle) {
        match self.obstacles.iter_mut().find(|one| one.name == obstacle.name) {
            Some(known) => *known = obstacle,
            None => self.obstacles.push(obstacle),
        }
    }

    /// Removes the first obstacle of this name, and returns it.
    pub fn remove(&mut self, name: &str) -> Option<Obstacle> {
        let place = self.obstacles.iter().position(|one| *one.name == *name)?;
        Some(self.obstacles.remove(place))
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
        Self::swept(name, &Translation3::from(centre).into(), &[[0.0; 3]], radius)
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
        let parts = pieces.iter();
        let parts = parts.map(|piece| part(&pose, piece.vertices.as_slice().into(), 0.0));
        let parts: Result<Vec<Part>, ShapeError> = parts.collect();
        whole.parts = parts.map_err(|error| fault(name, &error.to_string()))?;
        Ok(whole)
    }

    /// The same body with its frame at another pose, which its shapes are placed at: a mesh is not decomposed again.
    /// The frame of a sphere is at its centre.
    ///
    /// # Errors
    /// As [`Obstacle::cuboid`].
    pub fn at(&self, pose: Isometry3<f64>) -> Result<Self, RobotError> {
        let parts = self.parts.iter();
        let parts = parts.map(|own| part(&pose, Arc::clone(&own.own), own.radius));
        let parts: Result<Vec<Part>, ShapeError> = parts.collect();
        Ok(Self {
            parts: parts.map_err(|error| fault(&self.name, &error.to_string()))?,
            ..self.clone()
        })
    }

    /// Excludes a link, or an attached object, from the tests against this obstacle, such as the base mounted on it or
    /// the gripper that holds it. [`Proximity::world_proximity`](crate::Proximity::world_proximity) rejects an unknown
    /// link.
    pub fn ignoring(mut self, link: &str) -> Self {
        self.ignored.push(link.to_owned());
        self
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The links and attached objects that it ignores.
    pub(crate) fn ignored(&self) -> &[String] {
        &self.ignored
    }

    pub(crate) fn parts(&self) -> &[Part] {
        &self.parts
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
        let part =
            part(pose, points.into(), radius).map_err(|error| fault(name, &error.to_string()))?;
        Ok(Self { name: Arc::from(name), parts: vec![part], ignored: Vec::new() })
    }
}

fn part(pose: &Isometry3<f64>, own: Arc<[[f64; 3]]>, radius: f64) -> Result<Part, ShapeError> {
    let placed = own.iter();
    let placed = placed.map(|p| (pose * Point3::from(*p)).coords.into());
    let placed: Vec<[f64; 3]> = placed.collect();
    let core = ConvexShape::of_points(&placed)?;
    // Larger by more than what placing them rounds.
    let largest = placed.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
    let end = |k: usize, sign: f64| {
        let numbers = placed.iter().map(|p| sign * p[k]);
        sign * (numbers.fold(f64::NEG_INFINITY, f64::max) + 1e-12 * largest)
    };
    let mut sphere = about(core.centre(), &placed);
    sphere.radius += radius;
    Ok(Part {
        bounds: [-1.0, 1.0].map(|sign| [0, 1, 2].map(|k| end(k, sign))),
        core: Arc::new(core),
        radius,
        own,
        sphere,
    })
}

fn check_size(name: &str, size: f64) -> Result<(), RobotError> {
    match (0.0..=1e9).contains(&size) {
        true => Ok(()),
        false => Err(fault(name, &ShapeError::Size { size }.to_string())),
    }
}

fn fault(name: &str, reason: &str) -> RobotError {
    RobotError::Obstacle { name: name.to_owned(), reason: reason.to_owned() }
}
