//! Distances and collisions between the links of a robot.
//!
//! [`Robot::proximity`] prepares the shapes of one kind and their pairs that are not skipped. [`Queries`](crate::Queries)
//! has what can be asked. [`Proximity::attach`] adds an object that a link carries, [`Proximity::without`] leaves pairs out.
//!
//! Distances are accurate to 1e-9 m, and 0 for shapes that touch or overlap: `penetrations` says how far. Results do not
//! depend on the number of threads or on the batch.
//! Bounding spheres, of each shape and of all shapes of a link, exclude distant pairs. They are computed from the
//! shapes themselves, so a wrong box or sphere in the URDD cannot hide a collision between hulls or pieces.

mod changed;
mod query;
mod swept;

use std::collections::HashMap;
use std::sync::Arc;

use super::Robot;
use super::error::RobotError;
use super::kept::{Closure, Motion};
use super::robot::{check_link, index};
use super::shapes::ShapeKind;
use super::skips::{PairStatistics, Skips};
use super::workspace::{Derivative, Placed};
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_format::skips::HiddenContacts;
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_geometry::convex::Level;
use urdd_geometry::convex::across::columns;
use urdd_kinematics::Travel;

pub use swept::{Gradient, Overlap};
pub(super) use swept::{
    Shape, SweptPair, Waiting, in_root, penetration_of, relative, to_root, toward, witnesses,
};

/// The distance between two shapes, and their closest points.
#[derive(Debug, Clone, PartialEq)]
pub struct PairDistance {
    /// The names of the two links, or of attached objects.
    pub links: [Arc<str>; 2],
    /// The indices of the two links; for an attached object, of the link that it is attached to.
    pub link_idxs: [usize; 2],
    /// The indices of the two bodies: of the links, or, from the number of links on, of the attached objects in the order
    /// in which they were attached. [`Proximity::body_name`] has their names.
    pub body_idxs: [usize; 2],
    /// The indices of the pieces; 0 for hulls and their bounding volumes. For an attached object, of its parts.
    pub pieces: [usize; 2],
    /// In metres; 0 if they touch or overlap.
    pub distance: f64,
    /// The distance divided by the pair's mean distance in `link_shapes_distance_statistics_module`, which makes large
    /// and small links comparable. `None` if that module has no mean for the pair, or a mean of 0.
    pub relative: Option<f64>,
    /// The closest points of the two shapes, in the root link's frame, in metres. If the shapes overlap, both are the
    /// same point, which is in both shapes.
    pub points: [[f64; 3]; 2],
}

/// The distance of a pair of the robot's shapes, and how it changes.
pub type PairGradient = Gradient<PairDistance>;

/// The shapes of one kind, prepared for distances.
#[derive(Debug, Clone)]
pub struct Proximity {
    pub(super) motion: Arc<Motion>,
    /// What closes loops; for a motion alone, so that a fault of it is no fault of others.
    pub(super) closure: Result<Option<Arc<Closure>>, RobotError>,
    pub(super) kind: ShapeKind,
    /// Of the links, then of the attached objects.
    pub(super) names: Vec<Arc<str>>,
    pub(super) shapes: Vec<Shape>,
    /// For each link, the bounding sphere of all its shapes.
    pub(super) spheres: Vec<Option<BoundingSphere>>,
    pairs: Vec<Pair>,
    pub(super) groups: Vec<Group>,
    rounding: Rounding,
    pub(super) level: Level,
}

/// Which of the shapes have radii.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Rounding {
    None,
    Some,
    /// All of them are balls.
    Balls,
}

/// Two shapes that are not skipped.
#[derive(Debug, Clone, Copy)]
struct Pair {
    shapes: [usize; 2],
    mean: Option<f64>,
}

/// The pairs between two links: the range `first..end` of all pairs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Group {
    pub links: [usize; 2],
    /// Whether a DOF moves one link against the other.
    moves: bool,
    first: usize,
    end: usize,
}

impl Robot {
    /// Prepares the shapes of a kind, with the skips between them. A link without geometry never collides.
    ///
    /// # Errors
    /// If the module of the shapes, a skips module, `chain_module` or `dof_module` is missing or unusable, or a mesh
    /// cannot be read.
    pub fn proximity(&self, kind: ShapeKind) -> Result<Proximity, RobotError> {
        let skips = self.skips(kind)?;
        let is_skipped = |(i, j)| skips.is_skipped(i, j);
        self.prepared(kind, &skips, |_, both| !both.is_some_and(is_skipped))
    }

    /// As [`Robot::proximity`], for the pairs of shapes that `wanted` selects instead of those that are not skipped.
    /// `wanted` receives the link and the piece of each shape.
    pub fn proximity_of(
        &self,
        kind: ShapeKind,
        wanted: impl Fn([(usize, usize); 2]) -> bool,
    ) -> Result<Proximity, RobotError> {
        self.prepared(kind, &self.skips(kind)?, |shapes, _| {
            wanted(shapes.map(|shape| (shape.link, shape.piece)))
        })
    }

    /// As [`Robot::proximity`], for the pairs that are skipped because they touch in the default configuration, or in the
    /// reference configuration that `urdd generate` was given: where they touch, the robot collides, and the other queries
    /// call it free. Pairs that a person decided on are left out, and those of links that always touch. `None` if there are
    /// no such pairs.
    ///
    /// # Errors
    /// As [`Robot::proximity`].
    pub fn skipped_contacts(&self, kind: ShapeKind) -> Result<Option<Proximity>, RobotError> {
        let skips = self.skips(kind)?;
        let names = &self.shared_motion()?.links;
        let names = names.iter().map(String::as_str);
        let links = |i: usize, j: usize| {
            let [a, b] = [i, j].map(|shape| skips.places()[shape].0);
            [a.min(b), a.max(b)]
        };
        let pairs = || (0..skips.len()).flat_map(|i| (i + 1..skips.len()).map(move |j| (i, j)));
        let always = pairs().filter(|(i, j)| skips.reason(*i, *j) == Some(SkipReason::Always));
        let always = always.map(|(i, j)| links(i, j));
        let contacts = HiddenContacts::new(skips.edits(), names, always);
        let is_hidden = |i: usize, j: usize| {
            let links = links(i, j);
            let touches =
                |reason| contacts.touches_in(links, reason, skips.is_skipped(i, j)).is_some();
            skips.reason(i, j).is_some_and(touches)
        };
        // The shapes are read only where they are needed.
        if !pairs().any(|(i, j)| is_hidden(i, j)) {
            return Ok(None);
        }
        let wanted = |_: [&Shape; 2], both: Option<(usize, usize)>| {
            both.is_some_and(|(i, j)| is_hidden(i, j))
        };
        self.prepared(kind, &skips, wanted).map(Some)
    }

    /// `wanted` selects pairs of shapes, given the shapes and their indices in the skips.
    fn prepared(
        &self,
        kind: ShapeKind,
        skips: &Skips,
        wanted: impl Fn([&Shape; 2], Option<(usize, usize)>) -> bool,
    ) -> Result<Proximity, RobotError> {
        let motion = Arc::clone(self.shared_motion()?);
        let closure = self.closure().map(Option::<&Arc<_>>::cloned);
        let statistics = self.statistics()?;
        let index: HashMap<(usize, usize), usize> =
            skips.places().iter().enumerate().map(|(index, place)| (*place, index)).collect();
        let count = motion.links.len();
        let mut shapes = Vec::new();
        for shape in self.shapes(kind)? {
            check_link(shape.link, count)?;
            let own = Shape::of(shape.link, shape.piece, &shape.solid);
            shapes.push(own.map_err(|error| RobotError::Unusable {
                module: kind.module(),
                reason: format!("piece {} of link {}: {error}", shape.piece, shape.link),
            })?);
        }
        let of_shape = |shape: &Shape| index.get(&(shape.link, shape.piece)).copied();
        let indices: Vec<Option<usize>> = shapes.iter().map(of_shape).collect();
        let mut pairs = Vec::new();
        for (i, a) in shapes.iter().enumerate() {
            for (j, b) in shapes.iter().enumerate().skip(i + 1) {
                let both = indices[i].zip(indices[j]);
                if a.link == b.link || !wanted([a, b], both) {
                    continue;
                }
                let recorded = both.and_then(|(i, j)| PairStatistics::of(&statistics, kind, i, j));
                let mean = recorded.map(|pair| pair.mean);
                pairs.push(Pair { shapes: [i, j], mean: mean.filter(|mean| *mean > 0.0) });
            }
        }
        Ok(Proximity {
            names: motion.links.iter().map(|name| Arc::from(name.as_str())).collect(),
            spheres: Vec::new(),
            kind,
            shapes,
            pairs,
            closure,
            groups: Vec::new(),
            rounding: Rounding::None,
            level: Level::new(),
            motion,
        }
        .arranged())
    }
}

impl Proximity {
    /// The kind of the shapes.
    pub fn kind(&self) -> ShapeKind {
        self.kind
    }

    /// Number of shapes.
    pub fn num_shapes(&self) -> usize {
        self.shapes.len()
    }

    /// The link and the piece of both shapes of each pair that is checked, in the order of [`distances`](crate::Queries::distances): by
    /// first link, second link, and pieces.
    pub fn pairs(&self) -> impl ExactSizeIterator<Item = [(usize, usize); 2]> {
        let place = |shape: usize| (self.shapes[shape].link, self.shapes[shape].piece);
        self.pairs.iter().map(move |pair| pair.shapes.map(place))
    }

    /// The names of the links of [`Proximity::pairs`], or of attached objects.
    pub fn pair_names(&self) -> impl ExactSizeIterator<Item = [&str; 2]> {
        let name = |shape: usize| &**self.owner(&self.shapes[shape]);
        self.pairs.iter().map(move |pair| pair.shapes.map(name))
    }

    /// The bodies of [`Proximity::pairs`], as [`PairDistance::body_idxs`].
    pub fn pair_bodies(&self) -> impl ExactSizeIterator<Item = [usize; 2]> {
        self.pairs.iter().map(|pair| pair.shapes.map(|shape| self.shapes[shape].owner))
    }

    /// Number of bodies: links and attached objects.
    pub fn num_bodies(&self) -> usize {
        self.names.len()
    }

    /// The name of a link or of an attached object, by [`PairDistance::body_idxs`].
    pub fn body_name(&self, body: usize) -> Option<&str> {
        self.names.get(body).map(|name| &**name)
    }

    /// The index of a link or of an attached object.
    ///
    /// # Errors
    /// [`RobotError::Unknown`], with the nearest name.
    pub fn body(&self, name: &str) -> Result<usize, RobotError> {
        index("link or attached object", &self.names, name)
    }
}

impl Proximity {
    /// With the pairs in order, their groups, and the spheres of links.
    fn arranged(mut self) -> Self {
        let shapes = &self.shapes;
        self.rounding = match shapes.iter().all(|shape| shape.is_ball) {
            true if !shapes.is_empty() => Rounding::Balls,
            _ if shapes.iter().all(|shape| shape.radius == 0.0) => Rounding::None,
            _ => Rounding::Some,
        };
        let links = |pair: &Pair| pair.shapes.map(|shape| shapes[shape].link);
        self.pairs.sort_by_key(|pair| (links(pair), pair.shapes));
        self.groups.clear();
        let bodies = self.motion.kinematics.rigid_bodies();
        for (first, links) in self.pairs.iter().map(links).enumerate() {
            let (moves, end) = (bodies[links[0]] != bodies[links[1]], first + 1);
            match self.groups.last_mut() {
                Some(group) if group.links == links => group.end = end,
                _ => self.groups.push(Group { links, moves, first, end }),
            }
        }
        let count = self.motion.links.len();
        self.spheres = (0..count).map(|link| swept::about_link(shapes, link)).collect();
        self
    }

    /// The name of a shape's link, or of the attached object.
    pub(super) fn owner(&self, shape: &Shape) -> &Arc<str> {
        &self.names[shape.owner]
    }

    /// Places the links and the centres of the shapes.
    pub(super) fn place(
        &self,
        configuration: &[f64],
        placed: &mut Placed,
    ) -> Result<(), RobotError> {
        let kinematics = &self.motion.kinematics;
        kinematics.link_poses_into(configuration, &mut placed.poses)?;
        placed.links.clear();
        placed.links.extend(placed.poses.iter().map(columns));
        placed.centres.clear();
        let centre = |shape: &Shape| to_root(&placed.links[shape.link], shape.sphere.centre);
        placed.centres.extend(self.shapes.iter().map(centre));
        placed.around.clear();
        let links = placed.links.iter().zip(&self.spheres);
        let around =
            links.map(|(link, sphere)| sphere.map_or([0.0; 3], |one| to_root(link, one.centre)));
        placed.around.extend(around);
        Ok(())
    }

    pub(super) fn travel(&self, start: &[f64], end: &[f64]) -> Result<Travel<'_>, RobotError> {
        Ok(self.motion.kinematics.travel(start, end)?)
    }

    /// How fast two points of links, in the root link's frame, come apart in a direction with each DOF, m/rad or m/m.
    /// Without a second link, the second point stays.
    pub(crate) fn derivative<'a>(
        &self,
        configuration: &[f64],
        placed: &Placed,
        (a, b): (usize, Option<usize>),
        points: [[f64; 3]; 2],
        direction: [f64; 3],
        memory: &'a mut Derivative,
    ) -> &'a [f64] {
        let kinematics = &self.motion.kinematics;
        let dofs = kinematics.num_dofs();
        memory.jacobian.resize(6 * dofs, 0.0);
        memory.of_dofs.clear();
        memory.of_dofs.resize(dofs, 0.0);
        for (link, point, sign) in [(Some(a), points[0], -1.0), (b, points[1], 1.0)] {
            let Some(link) = link else { continue };
            let (poses, jacobian) = (&placed.poses, &mut memory.jacobian);
            kinematics.jacobian_into(configuration, poses, link, &point.into(), jacobian);
            for (sum, column) in memory.of_dofs.iter_mut().zip(jacobian.chunks_exact(6)) {
                let speed: f64 = (0..3).map(|k| direction[k] * column[k]).sum();
                *sum += sign * speed;
            }
        }
        &memory.of_dofs
    }
}
