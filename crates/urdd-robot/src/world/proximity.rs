//! Distances and collisions between a robot and obstacles.

use std::ops::Deref;
use std::sync::Arc;

use arrayvec::ArrayVec;

use crate::error::RobotError;
use crate::names::index;
use crate::obstacle::{Obstacle, Part, World};
use crate::proximity::{
    Least, Placed, Proximity, SweptPair, Waiting, Workspace, to_root, witnesses,
};
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_geometry::convex::across::{self, AT_ONCE, PlacedPair};
use urdd_geometry::vector::dot;

/// The distance between a shape of the robot and an obstacle, and their closest points.
#[derive(Debug, Clone, PartialEq)]
pub struct ObstacleDistance {
    /// The name of the link, or of the attached object.
    pub link: Arc<str>,
    /// The index of the link; for an attached object, of the link that it is attached to.
    pub link_idx: usize,
    /// The index of the link's piece; 0 for a hull and its bounding volumes. For an attached object, of its part.
    pub piece: usize,
    /// The name of the obstacle.
    pub obstacle: Arc<str>,
    /// The index of the obstacle in its world.
    pub obstacle_idx: usize,
    /// In metres; 0 if they touch or overlap.
    pub distance: f64,
    /// The closest points, of the link's shape and of the obstacle, in the root link's frame, in metres. If the two
    /// overlap, both are the same point, which is in both.
    pub points: [[f64; 3]; 2],
}

/// The indices of a shape and of a part of an obstacle.
pub(super) type Pair = (usize, usize);

/// A robot's shapes and a world, prepared for distance queries.
#[derive(Debug)]
pub struct WorldProximity<P> {
    pub(super) proximity: P,
    names: Vec<Arc<str>>,
    parts: Vec<(usize, Part)>,
    /// For each obstacle, the links and attached objects that are not tested against it.
    ignored: Vec<Vec<usize>>,
}

impl Proximity {
    /// Combines the robot's shapes with a world.
    ///
    /// # Errors
    /// [`RobotError::Unknown`] if an obstacle ignores a link that does not exist.
    pub fn world_proximity(&self, world: &World) -> Result<WorldProximity<&Proximity>, RobotError> {
        WorldProximity::new(self, world)
    }
}

impl<P: Deref<Target = Proximity>> WorldProximity<P> {
    /// As [`Proximity::world_proximity`], with borrowed or shared shapes.
    ///
    /// # Errors
    /// As there.
    pub fn new(proximity: P, world: &World) -> Result<Self, RobotError> {
        let ignored = |obstacle: &Obstacle| {
            let links = obstacle.ignored.iter();
            let known = |link: &String| index("link", &proximity.names, link);
            links.map(known).collect()
        };
        let ignored: Result<Vec<Vec<usize>>, RobotError> =
            world.obstacles.iter().map(ignored).collect();
        let obstacles = world.obstacles.iter().enumerate();
        let parts = obstacles
            .flat_map(|(k, obstacle)| obstacle.parts.iter().map(move |part| (k, part.clone())));
        Ok(WorldProximity {
            proximity,
            names: world.obstacles.iter().map(|one| one.name.clone()).collect(),
            parts: parts.collect(),
            ignored: ignored?,
        })
    }

    /// The tested pairs: each shape of the robot, as the indices of its link and piece, with the index of each obstacle
    /// that does not ignore its link. Sorted by shape, then by obstacle.
    pub fn pairs(&self) -> impl Iterator<Item = ([usize; 2], usize)> {
        let shapes = self.proximity.shapes.iter();
        shapes.flat_map(|shape| {
            let tested = (0..self.names.len()).filter(|k| !self.ignored[*k].contains(&shape.owner));
            tested.map(|obstacle| ([shape.link, shape.piece], obstacle))
        })
    }

    /// The name of the link of each of the [pairs](WorldProximity::pairs), or of the attached object.
    pub fn pair_names(&self) -> impl Iterator<Item = &str> {
        let shapes = self.proximity.shapes.iter();
        shapes.flat_map(|shape| {
            let tested = self.ignored.iter();
            let tested = tested.filter(|ignored| !ignored.contains(&shape.owner));
            tested.map(|_| &**self.proximity.owner(shape))
        })
    }

    /// The distance of each of the [pairs](WorldProximity::pairs), in metres.
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn distances(&self, configuration: &[f64]) -> Result<Vec<f64>, RobotError> {
        let placed = self.place(configuration)?;
        let tested: Vec<Pair> = self.tested().collect();
        let mut values = vec![0.0; tested.len()];
        for (pairs, out) in tested.chunks(AT_ONCE).zip(values.chunks_mut(AT_ONCE)) {
            self.values(&placed, pairs, out);
        }
        let values = values.into_iter().zip(&tested);
        let mut found: Vec<f64> = Vec::new();
        let mut last = None;
        // The parts of an obstacle are contiguous.
        for (value, (shape, part)) in values {
            let pair = Some((*shape, self.parts[*part].0));
            match found.last_mut() {
                Some(least) if pair == last => *least = least.min(value),
                _ => found.push(value),
            }
            last = pair;
        }
        Ok(found)
    }

    /// The minimum distance over all pairs, in metres; `None` if there are no pairs.
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn min_distance(&self, configuration: &[f64]) -> Result<Option<f64>, RobotError> {
        self.min_distance_with(configuration, &mut Workspace::default())
    }

    /// As [`WorldProximity::min_distance`], with memory that is used again: it does not allocate.
    ///
    /// # Errors
    /// As there.
    pub fn min_distance_with(
        &self,
        configuration: &[f64],
        workspace: &mut Workspace,
    ) -> Result<Option<f64>, RobotError> {
        let Workspace { placed, least_of_parts, .. } = workspace;
        self.place_into(configuration, placed)?;
        let nearest = self.least_pairs(placed, self.tested(), 1, least_of_parts);
        Ok(nearest.first().map(|(distance, _)| *distance))
    }

    /// For each shape of the robot and each tested obstacle, the distance to the obstacle's nearest part. Sorted by
    /// shape, in the order of links and pieces, then by obstacle.
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn closest_points(
        &self,
        configuration: &[f64],
    ) -> Result<Vec<ObstacleDistance>, RobotError> {
        let placed = self.place(configuration)?;
        let mut all = Vec::new();
        for shape in 0..self.proximity.shapes.len() {
            for obstacle in 0..self.names.len() {
                let own = |(_, part): &Pair| self.parts[*part].0 == obstacle;
                let pairs = self.pairs_of(shape).filter(own);
                all.extend(self.least(&placed, pairs, 1));
            }
        }
        Ok(all)
    }

    /// The `k` nearest pairs of a shape of the robot and a part of an obstacle, nearest first.
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn nearest(
        &self,
        configuration: &[f64],
        k: usize,
    ) -> Result<Vec<ObstacleDistance>, RobotError> {
        let placed = self.place(configuration)?;
        Ok(self.least(&placed, self.tested(), k))
    }

    /// Whether any shape of the robot touches or overlaps an obstacle.
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn in_collision(&self, configuration: &[f64]) -> Result<bool, RobotError> {
        self.in_collision_with(configuration, &mut Workspace::default())
    }

    /// As [`WorldProximity::in_collision`], with memory that is used again: it does not allocate.
    ///
    /// # Errors
    /// As there.
    pub fn in_collision_with(
        &self,
        configuration: &[f64],
        workspace: &mut Workspace,
    ) -> Result<bool, RobotError> {
        self.place_into(configuration, &mut workspace.placed)?;
        Ok(self.touches(&workspace.placed))
    }

    /// Whether any pair touches or overlaps.
    pub(super) fn touches(&self, placed: &Placed) -> bool {
        let mut waiting = Waiting::new(self.proximity.level);
        let mut near = self.tested().filter(|pair| self.bound(placed, *pair) <= 0.0);
        near.any(|pair| waiting.touches_with(self.cores(placed, pair), self.radii(pair)))
            || waiting.any_touches()
    }

    /// Number of pairs of a shape of the robot and a part of an obstacle: the most that [`WorldProximity::nearest`]
    /// returns.
    pub fn num_pairs_of_parts(&self) -> usize {
        self.tested().count()
    }

    pub(super) fn tested(&self) -> impl Iterator<Item = Pair> {
        let shapes = 0..self.proximity.shapes.len();
        shapes.flat_map(|shape| self.pairs_of(shape))
    }

    fn pairs_of(&self, shape: usize) -> impl Iterator<Item = Pair> {
        let owner = self.proximity.shapes[shape].owner;
        let parts = self.parts.iter().enumerate();
        let tested =
            parts.filter(move |(_, (obstacle, _))| !self.ignored[*obstacle].contains(&owner));
        tested.map(move |(part, _)| (shape, part))
    }

    pub(super) fn place(&self, configuration: &[f64]) -> Result<Placed, RobotError> {
        let mut placed = Placed::default();
        self.place_into(configuration, &mut placed)?;
        Ok(placed)
    }

    pub(super) fn place_into(
        &self,
        configuration: &[f64],
        placed: &mut Placed,
    ) -> Result<(), RobotError> {
        self.proximity.place(configuration, placed)?;
        self.proximity.place_centres(placed);
        Ok(())
    }

    /// A lower bound of the distance of a pair, in metres; not positive if it may touch.
    pub(super) fn bound(&self, placed: &Placed, (shape, part): Pair) -> f64 {
        let sphere = BoundingSphere {
            centre: placed.centres[shape],
            radius: self.proximity.shapes[shape].sphere.radius,
        };
        self.parts[part].1.bound(&sphere)
    }

    pub(super) fn least(
        &self,
        placed: &Placed,
        pairs: impl Iterator<Item = Pair>,
        k: usize,
    ) -> Vec<ObstacleDistance> {
        let mut least = Least::default();
        let best = self.least_pairs(placed, pairs, k, &mut least).iter();
        let pairs: Vec<Pair> = best.map(|(_, pair)| *pair).collect();
        self.witnesses(placed, &pairs)
    }

    /// The `k` nearest of these pairs, with their distances.
    fn least_pairs<'a>(
        &self,
        placed: &Placed,
        pairs: impl Iterator<Item = Pair>,
        k: usize,
        least: &'a mut Least<Pair>,
    ) -> &'a [(f64, Pair)] {
        let bounds = pairs.map(|pair| (self.bound(placed, pair), pair));
        least.of(bounds, k, |pairs, values| {
            self.values(placed, pairs, values);
        })
    }

    /// The cores of a shape of the robot and a part of an obstacle, with the part placed in the frame of the shape's link.
    fn cores(&self, placed: &Placed, (shape, part): Pair) -> PlacedPair<'_> {
        let own = &self.proximity.shapes[shape];
        let link = &placed.links[own.link];
        let back = |v: [f64; 3]| [0, 1, 2].map(|k| dot(link[k], v));
        let axis = |k: usize| [link[0][k], link[1][k], link[2][k]];
        PlacedPair {
            a: &own.core,
            b: &self.parts[part].1.core,
            b_in_a: [axis(0), axis(1), axis(2), back(link[3].map(|x| -x))],
        }
    }

    /// The sum of the radii of a pair.
    fn radii(&self, (shape, part): Pair) -> f64 {
        self.proximity.shapes[shape].radius + self.parts[part].1.radius
    }

    pub(super) fn swept(&self, placed: &Placed, pair: Pair) -> SweptPair<'_> {
        let own = self.proximity.shapes[pair.0].radius;
        SweptPair { cores: self.cores(placed, pair), radii: [own, self.parts[pair.1].1.radius] }
    }

    /// The distances of some pairs, at most [`AT_ONCE`].
    pub(super) fn values(&self, placed: &Placed, pairs: &[Pair], values: &mut [f64]) {
        let cores = pairs.iter().map(|pair| self.cores(placed, *pair));
        let cores: ArrayVec<PlacedPair, AT_ONCE> = cores.collect();
        across::distances(self.proximity.level, &cores, values);
        for (value, pair) in values.iter_mut().zip(pairs) {
            *value = (*value - self.radii(*pair)).max(0.0);
        }
    }

    fn witnesses(&self, placed: &Placed, pairs: &[Pair]) -> Vec<ObstacleDistance> {
        let both = pairs.iter().map(|pair| self.swept(placed, *pair));
        let found = witnesses(self.proximity.level, &both.collect::<Vec<_>>());
        let each = pairs.iter().zip(found);
        each.map(|(pair, (distance, points))| {
            let link = self.proximity.shapes[pair.0].link;
            let points = points.map(|p| to_root(&placed.links[link], p));
            self.obstacle_distance(*pair, distance, points)
        })
        .collect()
    }

    pub(super) fn obstacle_distance(
        &self,
        (shape, part): Pair,
        distance: f64,
        points: [[f64; 3]; 2],
    ) -> ObstacleDistance {
        let own = &self.proximity.shapes[shape];
        let obstacle = self.parts[part].0;
        ObstacleDistance {
            link: Arc::clone(self.proximity.owner(own)),
            link_idx: own.link,
            piece: own.piece,
            obstacle: self.names[obstacle].clone(),
            obstacle_idx: obstacle,
            distance,
            points,
        }
    }
}
