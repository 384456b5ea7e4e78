//! Bodies that a robot must not touch, or that its links carry.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Translation3};

use crate::copies::Copies;
use crate::error::RobotError;
use urdd_geometry::Mesh;
use urdd_geometry::bounding_sphere::{BoundingSphere, about};
use urdd_geometry::convex::{ConvexShape, ShapeError};
use urdd_geometry::decompose::{self, decompose};
use urdd_geometry::mesh::Bounds;
use urdd_geometry::oriented_box::corners;
use urdd_geometry::primitives::{Primitive, Prism};
use urdd_geometry::vector::norm;

/// Maximum number of points of a cloud, and of heights of a field: they take about a gigabyte.
pub const MAX_POINTS: usize = 10_000_000;

/// A body that a robot must not touch, or that a link carries: [`Proximity::attach`](crate::Proximity::attach). Clones
/// share its shapes.
#[derive(Debug, Clone)]
pub struct Obstacle {
    pub(crate) name: Arc<str>,
    /// Of its frame.
    pub(crate) pose: Isometry3<f64>,
    pub(crate) parts: Arc<[Part]>,
    pub(crate) form: Form,
    /// Names of links and attached objects that may touch it.
    pub(crate) ignored: Arc<Vec<String>>,
}

/// What an obstacle is, where its parts are not exactly that, or not simply.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Form {
    /// Its half extents, m.
    Box([f64; 3]),
    /// Its radius, m.
    Sphere(f64),
    /// Along z, m.
    Capsule { radius: f64, half: f64 },
    /// Along z, m.
    Cylinder { radius: f64, half: f64 },
    /// Its parts.
    Parts,
}

/// A convex shape swept by a sphere, or copies of one: all points within `radius` of the shape, in the frame of its obstacle.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    pub core: Arc<ConvexShape>,
    pub radius: f64,
    /// Where the shape is, if it is at many places.
    pub copies: Option<Arc<Copies>>,
    points: Arc<[[f64; 3]]>,
    /// Of the points, in metres.
    pub bounds: Bounds,
    /// Around the part.
    pub sphere: BoundingSphere,
}

impl Part {
    fn new(points: Arc<[[f64; 3]]>, radius: f64) -> Result<Self, ShapeError> {
        let core = Arc::new(ConvexShape::of_points(&points)?);
        let bounds = Bounds::of(points.iter().copied());
        let mut sphere = about(core.centre(), &points);
        sphere.radius += radius;
        Ok(Part { core, radius, copies: None, bounds, points, sphere })
    }

    /// Copies of a box about the origin, swept by a sphere.
    fn of_copies(half: [f64; 3], radius: f64, centres: Vec<[f64; 3]>) -> Result<Self, ShapeError> {
        // The same limits as for other shapes.
        if centres.is_empty() {
            return Err(ShapeError::Empty);
        }
        let is_far = |p: &[f64; 3]| !p.iter().all(|x| x.abs() <= 1e9);
        if let Some(vertex) = centres.iter().position(is_far) {
            return Err(ShapeError::OutOfRange { vertex });
        }
        let core = match half {
            [0.0, 0.0, 0.0] => ConvexShape::of_points(&[[0.0; 3]])?,
            half => ConvexShape::of_points(&corners(half))?,
        };
        let copies = Arc::new(Copies::new(core, half, centres));
        let Bounds { min, max } = copies.bounds;
        let points: Arc<[[f64; 3]]> = [min, max].into();
        let middle = [0, 1, 2].map(|k| 0.5 * (min[k] + max[k]));
        let mut sphere = about(middle, &points);
        sphere.radius += radius;
        let (core, bounds) = (Arc::clone(&copies.core), copies.bounds);
        Ok(Part { core, radius, copies: Some(copies), bounds, points, sphere })
    }

    /// A lower bound of the distance of the part from a sphere in its frame, in metres; not positive if they may touch.
    pub fn bound(&self, sphere: &BoundingSphere) -> f64 {
        let Bounds { min: least, max: most } = self.bounds;
        let p = sphere.centre;
        if let Some(copies) = &self.copies {
            let apart = copies.nearest(p).1.sqrt();
            return apart * (1.0 - 1e-12) - sphere.radius - self.radius;
        }
        let apart = [0, 1, 2].map(|k| (least[k] - p[k]).max(p[k] - most[k]).max(0.0));
        // Less by more than any rounding error.
        norm(apart) * (1.0 - 1e-12) - sphere.radius - self.radius
    }

    /// The shape at a pose, and a sphere around the part.
    pub fn placed(
        &self,
        pose: &Isometry3<f64>,
    ) -> Result<(ConvexShape, BoundingSphere), ShapeError> {
        let placed = self.points.iter().map(|p| (pose * Point3::from(*p)).coords.into());
        let placed: Vec<[f64; 3]> = placed.collect();
        let core = ConvexShape::of_points(&placed)?;
        let mut sphere = about(core.centre(), &placed);
        sphere.radius += self.radius;
        Ok((core, sphere))
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

    /// Adds an obstacle, or replaces the first one of its name: one that came, or [moved](Obstacle::at).
    /// [`Proximity::world_proximity`](crate::Proximity::world_proximity) prepares no shape again;
    /// [`WorldProximity::move_obstacles`](crate::WorldProximity::move_obstacles) moves without it.
    pub fn put(&mut self, obstacle: Obstacle) {
        match self.obstacles.iter_mut().find(|one| one.name == obstacle.name) {
            Some(known) => *known = obstacle,
            None => self.obstacles.push(obstacle),
        }
    }

    /// Adds a cloud of points, or replaces the first obstacle of its name: [`Obstacle::points`] in the root link's frame.
    ///
    /// # Errors
    /// [`RobotError::Obstacle`].
    pub fn add_points(
        &mut self,
        name: &str,
        points: &[[f64; 3]],
        radius: f64,
    ) -> Result<(), RobotError> {
        self.put(Obstacle::points(name, Isometry3::identity(), points, radius)?);
        Ok(())
    }

    /// Removes the first obstacle of this name, and returns it.
    pub fn remove(&mut self, name: &str) -> Option<Obstacle> {
        let place = self.obstacles.iter().position(|one| *one.name == *name)?;
        Some(self.obstacles.remove(place))
    }
}

/// Each constructor fails with [`RobotError::Obstacle`] if a size is not finite, negative or larger than 1e9 m, if a point or
/// the pose is not finite or farther than 1e9 m from the origin, or if there are no points or more than 10,000,000.
impl Obstacle {
    /// A box: the pose of its centre and axes, and its half extents, in metres.
    pub fn cuboid(
        name: &str,
        pose: Isometry3<f64>,
        half_extents: [f64; 3],
    ) -> Result<Self, RobotError> {
        for size in half_extents {
            check_size(name, size)?;
        }
        Self::swept(name, pose, &corners(half_extents), 0.0, Form::Box(half_extents))
    }

    /// A sphere: its centre and radius, in metres.
    pub fn sphere(name: &str, centre: [f64; 3], radius: f64) -> Result<Self, RobotError> {
        let pose = Translation3::from(centre).into();
        Self::swept(name, pose, &[[0.0; 3]], radius, Form::Sphere(radius))
    }

    /// A capsule: all points within `radius` of a segment along the z axis of its frame, from `-half_length` to
    /// `half_length`.
    pub fn capsule(
        name: &str,
        pose: Isometry3<f64>,
        radius: f64,
        half_length: f64,
    ) -> Result<Self, RobotError> {
        check_size(name, half_length)?;
        let ends = [-half_length, half_length].map(|z| [0.0, 0.0, z]);
        Self::swept(name, pose, &ends, radius, Form::Capsule { radius, half: half_length })
    }

    /// A cylinder along the z axis of its frame, from `-half_length` to `half_length`. It is approximated by a
    /// circumscribed prism with 64 sides, which exceeds the radius by up to 0.13 %; a [`SphereChecker`](crate::spheres::SphereChecker) has
    /// the cylinder itself.
    pub fn cylinder(
        name: &str,
        pose: Isometry3<f64>,
        radius: f64,
        half_length: f64,
    ) -> Result<Self, RobotError> {
        check_size(name, radius)?;
        check_size(name, half_length)?;
        let cylinder = Primitive::Cylinder { radius, half: half_length };
        let form = Form::Cylinder { radius, half: half_length };
        Self::swept(name, pose, &cylinder.core(Prism::Around).0, 0.0, form)
    }

    /// The convex hull of points, in metres.
    pub fn hull(name: &str, pose: Isometry3<f64>, points: &[[f64; 3]]) -> Result<Self, RobotError> {
        Self::swept(name, pose, points, 0.0, Form::Parts)
    }

    /// A mesh, decomposed into convex pieces as `urdd generate` does for links, at the same cost. Cavities remain as
    /// far as the decomposition preserves them. [`Obstacle::hull`] is fast, and fills cavities.
    pub fn mesh(name: &str, pose: Isometry3<f64>, mesh: &Mesh) -> Result<Self, RobotError> {
        // Checks the limits of the points before the decomposition.
        let mut whole = Self::hull(name, pose, &mesh.vertices)?;
        let pieces = decompose(mesh, &decompose::Settings::default()).pieces;
        if pieces.is_empty() {
            return Ok(whole);
        }
        let parts = pieces.iter().map(|piece| Part::new(piece.vertices.as_slice().into(), 0.0));
        let parts: Result<Arc<[Part]>, ShapeError> = parts.collect();
        whole.parts = parts.map_err(|error| fault(name, &error))?;
        Ok(whole)
    }

    /// A cloud of points, in metres: all points that are at most `radius` (m, 0 allowed) from one of them. It is one part, in
    /// which a tree finds the points near a shape: 100,000 are fine.
    pub fn points(
        name: &str,
        pose: Isometry3<f64>,
        points: &[[f64; 3]],
        radius: f64,
    ) -> Result<Self, RobotError> {
        Self::check_count(name, points.len())?;
        Self::whole(name, pose, radius, Form::Parts, || {
            Part::of_copies([0.0; 3], radius, points.to_vec())
        })
    }

    /// A field of heights over the x-y plane of its frame. Cell (`row`, `column`) is a column with the sizes `cell` (m) along x
    /// and y, its centre at x = `column` * `cell[0]`, y = `row` * `cell[1]`. It reaches from its height, which is
    /// `heights[row * columns + column]` (m), `thickness` (m) down. There are no slopes between cells.
    ///
    /// # Errors
    /// Also if the number of heights is not a multiple of `columns`.
    pub fn height_field(
        name: &str,
        pose: Isometry3<f64>,
        heights: &[f64],
        columns: usize,
        cell: [f64; 2],
        thickness: f64,
    ) -> Result<Self, RobotError> {
        for size in [cell[0], cell[1], thickness] {
            check_size(name, size)?;
        }
        Self::check_count(name, heights.len())?;
        if columns == 0 || !heights.len().is_multiple_of(columns) {
            let reason = format!("{} heights do not divide into {columns} columns", heights.len());
            return Err(RobotError::Obstacle { name: name.to_owned(), reason });
        }
        let half = [cell[0], cell[1], thickness].map(|size| 0.5 * size);
        let centre = |(k, height): (usize, &f64)| {
            let (row, column) = (k / columns, k % columns);
            [column as f64 * cell[0], row as f64 * cell[1], height - half[2]]
        };
        let centres = heights.iter().enumerate().map(centre).collect();
        Self::whole(name, pose, 0.0, Form::Parts, || Part::of_copies(half, 0.0, centres))
    }

    /// Checks the number of points of a cloud, or of heights of a field, before memory is taken for them.
    ///
    /// # Errors
    /// [`RobotError::Obstacle`] if there are more than 10,000,000.
    pub fn check_count(name: &str, count: usize) -> Result<(), RobotError> {
        if count <= MAX_POINTS {
            return Ok(());
        }
        let reason = format!(
            "there are {count} points, and {MAX_POINTS} are allowed; leave out those that are near others, or make several obstacles"
        );
        Err(RobotError::Obstacle { name: name.to_owned(), reason })
    }

    /// The same body with its frame at another pose. Nothing is prepared again: the two share their shapes. The frame of
    /// a sphere is at its centre.
    ///
    /// # Errors
    /// [`RobotError::Obstacle`] if the pose is not finite, or farther than 1e9 m from the origin.
    pub fn at(&self, pose: Isometry3<f64>) -> Result<Self, RobotError> {
        check_pose(&self.name, &pose)?;
        Ok(Self { pose, ..self.clone() })
    }

    /// The pose of its frame.
    pub fn pose(&self) -> &Isometry3<f64> {
        &self.pose
    }

    /// Excludes a link, or an attached object, from the tests against this obstacle, such as the base mounted on it or
    /// the gripper that holds it. [`Proximity::world_proximity`](crate::Proximity::world_proximity) rejects an unknown
    /// link.
    pub fn ignoring(mut self, link: &str) -> Self {
        Arc::make_mut(&mut self.ignored).push(link.to_owned());
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
        pose: Isometry3<f64>,
        points: &[[f64; 3]],
        radius: f64,
        form: Form,
    ) -> Result<Self, RobotError> {
        Self::whole(name, pose, radius, form, || Part::new(points.into(), radius))
    }

    fn whole(
        name: &str,
        pose: Isometry3<f64>,
        radius: f64,
        form: Form,
        part: impl FnOnce() -> Result<Part, ShapeError>,
    ) -> Result<Self, RobotError> {
        check_size(name, radius)?;
        check_pose(name, &pose)?;
        let parts = [part().map_err(|error| fault(name, &error))?].into();
        Ok(Self { name: name.into(), pose, parts, form, ignored: Arc::default() })
    }
}

fn check_size(name: &str, size: f64) -> Result<(), RobotError> {
    match (0.0..=1e9).contains(&size) {
        true => Ok(()),
        false => Err(fault(name, &ShapeError::Size { size })),
    }
}

pub(crate) fn check_pose(name: &str, pose: &Isometry3<f64>) -> Result<(), RobotError> {
    let is_near = pose.translation.vector.iter().all(|x| x.abs() <= 1e9);
    match is_near && pose.rotation.coords.iter().all(|x| x.is_finite()) {
        true => Ok(()),
        false => Err(fault(name, &ShapeError::Pose)),
    }
}

/// Checks poses of the obstacles from `first` on, of those of these names.
///
/// # Errors
/// [`RobotError::OutOfRange`] if there are fewer obstacles; [`RobotError::Obstacle`] for a pose that is out of range.
pub(crate) fn check_moves(
    names: &[Arc<str>],
    first: usize,
    poses: &[Isometry3<f64>],
) -> Result<(), RobotError> {
    let moved = first.checked_add(poses.len()).and_then(|end| names.get(first..end));
    let Some(moved) = moved else {
        let index = first.saturating_add(poses.len().saturating_sub(1));
        return Err(RobotError::OutOfRange { what: "obstacle", index, count: names.len() });
    };
    moved.iter().zip(poses).try_for_each(|(name, pose)| check_pose(name, pose))
}

pub(crate) fn fault(name: &str, reason: &ShapeError) -> RobotError {
    RobotError::Obstacle { name: name.to_owned(), reason: reason.to_string() }
}
