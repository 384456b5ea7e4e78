//! How near the parts of a robot are to each other.
//!
//! [`Robot::proximity`] prepares the shapes of one kind and the pairs of them that are not skipped; then
//! [`Proximity::distances`] gives all pairs, [`Proximity::nearest`] the nearest ones, [`Proximity::self_distance`] the
//! least distance, and [`Proximity::in_collision`] yes or no, which is answered soonest. Each has a form for many
//! configurations, which uses all threads of rayon's pool. Results do not depend on the number of threads, nor on what
//! is asked together.
//!
//! Distances are right within 1e-9 m, and 0 for shapes that touch or overlap: depths of penetration are not given.
//! Pairs far apart are passed over by spheres about the shapes and about all shapes of a link, which are made from the
//! shapes themselves; so a wrong box or sphere in the URDD hides no collision of hulls or pieces.

mod batch;
mod body;
mod bound;
mod query;

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::Isometry3;

use self::body::{Sphere, body};
use super::Robot;
use super::error::RobotError;
use super::kinematics::Motion;
use super::shapes::ShapeKind;
use super::skips::Skips;
use super::statistics::AllStatistics;
use urdd_geometry::convex::Level;

pub use batch::Until;
pub(super) use body::Body;

/// What is nearest in a pair of shapes.
#[derive(Debug, Clone, PartialEq)]
pub struct PairDistance {
    /// The names of the two links.
    pub links: [Arc<str>; 2],
    /// The indices of the two links.
    pub link_idxs: [usize; 2],
    /// Which pieces of the links they are; 0 for hulls and what is about them.
    pub pieces: [usize; 2],
    /// Metres; 0 where they touch or overlap.
    pub distance: f64,
    /// The distance over the pair's mean distance in `link_shapes_distance_statistics_module`: a measure of nearness
    /// that is alike for large links and small ones. `None` where that module has none, or a mean of 0.
    pub relative: Option<f64>,
    /// The point of each shape at which the distance is, in the root link's frame, metres; where they overlap, both are
    /// one point of both.
    pub points: [[f64; 3]; 2],
}

/// The shapes of one kind, prepared for distances.
#[derive(Debug)]
pub struct Proximity {
    motion: Arc<Motion>,
    pub(super) kind: ShapeKind,
    pub(super) names: Vec<Arc<str>>,
    pub(super) shapes: Vec<Shape>,
    /// For each link the sphere about all its shapes.
    spheres: Vec<Option<Sphere>>,
    pairs: Vec<Pair>,
    groups: Vec<Group>,
    pub(super) level: Level,
}

#[derive(Debug)]
pub(super) struct Shape {
    pub link: usize,
    pub piece: usize,
    pub body: Body,
    pub sphere: Sphere,
}

/// Two shapes that are not skipped.
#[derive(Debug, Clone, Copy)]
struct Pair {
    shapes: [usize; 2],
    mean: Option<f64>,
}

/// The pairs between two links: a stretch of all pairs.
#[derive(Debug, Clone, Copy)]
struct Group {
    links: [usize; 2],
    first: usize,
    end: usize,
}

impl Robot {
    /// Prepares the shapes of a kind, with the skips between them. Shapes that the URDD does not have take no part: a
    /// link without geometry never collides.
    ///
    /// # Errors
    /// Where a module is missing or of no use: that of the shapes, of the skips, `chain_module` or `dof_module`; and
    /// where a mesh cannot be read.
    pub fn proximity(&self, kind: ShapeKind) -> Result<Proximity, RobotError> {
        let skips = self.skips(kind)?;
        let is_skipped = |(i, j)| skips.is_skipped(i, j);
        self.prepared(kind, &skips, |_, both| !both.is_some_and(is_skipped))
    }

    /// As [`Robot::proximity`], for the pairs of shapes that are `wanted` instead of those that are not skipped. A shape
    /// is given by its link and its piece.
    ///
    /// # Errors
    /// As [`Robot::proximity`].
    pub fn proximity_of(
        &self,
        kind: ShapeKind,
        wanted: impl Fn([(usize, usize); 2]) -> bool,
    ) -> Result<Proximity, RobotError> {
        self.prepared(kind, &self.skips(kind)?, |shapes, _| {
            wanted(shapes.map(|shape| (shape.link, shape.piece)))
        })
    }

    /// `wanted` says which pairs of shapes count, by the shapes and by their indices in the skips.
    fn prepared(
        &self,
        kind: ShapeKind,
        skips: &Skips,
        wanted: impl Fn([&Shape; 2], Option<(usize, usize)>) -> bool,
    ) -> Result<Proximity, RobotError> {
        let motion = Arc::clone(self.shared_motion()?);
        let statistics = self.statistics(kind)?;
        let index: HashMap<(usize, usize), usize> = skips
            .places()
            .iter()
            .enumerate()
            .map(|(index, place)| (*place, index))
            .collect();
        let count = motion.links.len();
        let mut shapes = Vec::new();
        for shape in self.shapes(kind)? {
            if shape.link >= count {
                let (what, index) = ("link", shape.link);
                return Err(RobotError::OutOfRange { what, index, count });
            }
            let (body, sphere) = body(&shape.solid).map_err(|error| RobotError::Unusable {
                module: kind.module(),
                reason: format!("piece {} of link {}: {error}", shape.piece, shape.link),
            })?;
            shapes.push(Shape {
                link: shape.link,
                piece: shape.piece,
                body,
                sphere,
            });
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
                let recorded = |all: &AllStatistics| both.and_then(|(i, j)| all.pair(i, j));
                let mean = statistics.as_ref().and_then(recorded).map(|pair| pair.mean);
                pairs.push(Pair {
                    shapes: [i, j],
                    mean: mean.filter(|mean| *mean > 0.0),
                });
            }
        }
        let links = |pair: &Pair| pair.shapes.map(|shape| shapes[shape].link);
        pairs.sort_by_key(|pair| (links(pair), pair.shapes));
        let mut groups: Vec<Group> = Vec::new();
        for (at, pair) in pairs.iter().enumerate() {
            match groups.last_mut() {
                Some(group) if group.links == links(pair) => group.end = at + 1,
                _ => groups.push(Group {
                    links: links(pair),
                    first: at,
                    end: at + 1,
                }),
            }
        }
        Ok(Proximity {
            names: motion
                .links
                .iter()
                .map(|name| Arc::from(name.as_str()))
                .collect(),
            spheres: (0..count).map(|link| body::about(&shapes, link)).collect(),
            kind,
            shapes,
            pairs,
            groups,
            level: Level::new(),
            motion,
        })
    }
}

impl Proximity {
    /// Of which kind the shapes are.
    pub fn kind(&self) -> ShapeKind {
        self.kind
    }

    /// Number of shapes.
    pub fn num_shapes(&self) -> usize {
        self.shapes.len()
    }

    /// Number of pairs that are not skipped.
    pub fn num_pairs(&self) -> usize {
        self.pairs.len()
    }

    /// Number of values of a configuration.
    pub fn num_dofs(&self) -> usize {
        self.motion.kinematics.num_dofs()
    }

    /// The links and the pieces of each pair that is not skipped, in the order of [`Proximity::distances`]: by the
    /// first link, the second link, and their pieces.
    pub fn pairs(&self) -> impl ExactSizeIterator<Item = [(usize, usize); 2]> {
        let place = |shape: usize| (self.shapes[shape].link, self.shapes[shape].piece);
        self.pairs.iter().map(move |pair| pair.shapes.map(place))
    }

    /// The name of a link.
    pub fn link_name(&self, link: usize) -> Option<&str> {
        self.names.get(link).map(|name| &**name)
    }
}

/// Where everything is in one configuration. It is used again for the next one.
#[derive(Default)]
pub(super) struct Placed {
    poses: Vec<Isometry3<f64>>,
    /// Of each link the columns of the rotation, then the shift.
    pub links: Vec<[[f64; 3]; 4]>,
    /// The centre of the sphere about each shape.
    pub centres: Vec<[f64; 3]>,
}

impl Proximity {
    pub(super) fn place(
        &self,
        configuration: &[f64],
        placed: &mut Placed,
    ) -> Result<(), RobotError> {
        let kinematics = &self.motion.kinematics;
        kinematics.link_poses_into(configuration, &mut placed.poses)?;
        placed.links.clear();
        placed.links.extend(placed.poses.iter().map(|pose| {
            let rotation = pose.rotation.to_rotation_matrix();
            let column = |k: usize| rotation.matrix().column(k).into_owned().into();
            let shift = pose.translation.vector.into();
            [column(0), column(1), column(2), shift]
        }));
        Ok(())
    }

    /// The pose of the link of `b` in the frame of that of `a`.
    fn relative(placed: &Placed, a: usize, b: usize) -> [[f64; 3]; 4] {
        let (a, b) = (&placed.links[a], &placed.links[b]);
        let back = |v: [f64; 3]| [0, 1, 2].map(|k| dot(a[k], v));
        let between = [0, 1, 2].map(|k| b[3][k] - a[3][k]);
        [back(b[0]), back(b[1]), back(b[2]), back(between)]
    }
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A point of a link's frame in the root link's frame.
pub(super) fn to_root(link: &[[f64; 3]; 4], p: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| link[0][k] * p[0] + link[1][k] * p[1] + link[2][k] * p[2] + link[3][k])
}
