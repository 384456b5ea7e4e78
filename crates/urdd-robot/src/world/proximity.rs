//! Distances and collisions between a robot and obstacles.

use std::ops::Deref;
use std::sync::Arc;

use arrayvec::ArrayVec;

use super::obstacle::{Obstacle, Part, World};
use crate::error::RobotError;
use crate::names::index;
use crate::proximity::{Body, Least, Placed, Proximity, Workspace, to_root};
use urdd_geometry::convex::Witness;
use urdd_geometry::convex::across::{self, AT_ONCE, PlacedPair};
use urdd_geometry::vector::{dot, norm, sub};

/// The distance between a shape of the robot and an obstacle, and their closest points.
#[derive(Debug, Clone, PartialEq)]
pub struct ObstacleDistance {
    /// The name of the link.
    pub link: Arc<str>,
    /// The index of the link.
    pub link_idx: usize,
    /// The index of the link's piece; 0 for a hull and its bounding volumes.
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
type Pair = (usize, usize);

/// A robot's shapes and a world, prepared for distance queries.
#[derive(Debug)]
pub struct WorldProximity<P> {
    proximity: P,
    names: Vec<Arc<str>>,
    parts: Vec<(usize, Part)>,
    /// For each obstacle, the links that are not tested against it.
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
        let names: Vec<String> = proximity.names.iter().map(ToString::to_string).collect();
        let ignored = |obstacle: &Obstacle| {
            let links = obstacle.ignored.iter();
            links.map(|link| index("link", &names, link)).collect()
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
            let tested = (0..self.names.len()).filter(|k| !self.ignored[*k].contains(&shape.link));
            tested.map(|obstacle| ([shape.link, shape.piece], obstacle))
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
        let Workspace {
            placed,
            least_of_parts,
            ..
        } = workspace;
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
        let placed = &mut workspace.placed;
        self.place_into(configuration, placed)?;
        let mut near = self
            .tested()
            .filter(|pair| self.bound(placed, *pair) <= 0.0);
        loop {
            let pairs: ArrayVec<Pair, AT_ONCE> = near.by_ref().take(AT_ONCE).collect();
            let mut values = [f64::INFINITY; AT_ONCE];
            self.values(placed, &pairs, &mut values[..pairs.len()]);
            if values.contains(&0.0) {
                return Ok(true);
            }
            if !pairs.is_full() {
                return Ok(false);
            }
        }
    }

    /// Number of pairs of a shape of the robot and a part of an obstacle: the most that [`WorldProximity::nearest`]
    /// returns.
    pub fn num_pairs_of_parts(&self) -> usize {
        self.tested().count()
    }

    fn tested(&self) -> impl Iterator<Item = Pair> {
        let shapes = 0..self.proximity.shapes.len();
        shapes.flat_map(|shape| self.pairs_of(shape))
    }

    fn pairs_of(&self, shape: usize) -> impl Iterator<Item = Pair> {
        let link = self.proximity.shapes[shape].link;
        let parts = self.parts.iter().enumerate();
        let tested =
            parts.filter(move |(_, (obstacle, _))| !self.ignored[*obstacle].contains(&link));
        tested.map(move |(part, _)| (shape, part))
    }

    fn place(&self, configuration: &[f64]) -> Result<Placed, RobotError> {
        let mut placed = Placed::default();
        self.place_into(configuration, &mut placed)?;
        Ok(placed)
    }

    fn place_into(&self, configuration: &[f64], placed: &mut Placed) -> Result<(), RobotError> {
        self.proximity.place(configuration, placed)?;
        self.proximity.place_centres(placed);
        Ok(())
    }

    /// A lower bound of the distance of a pair, in metres; not positive if it may touch.
    fn bound(&self, placed: &Placed, (shape, part): Pair) -> f64 {
        let part = &self.parts[part].1;
        let (p, q) = (placed.centres[shape], part.shape.centre());
        let reach = self.proximity.shapes[shape].sphere.radius + part.reach + part.radius;
        // Reduced by more than any rounding error.
        norm(sub(q, p)) * (1.0 - 1e-12) - reach
    }

    fn least(
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

    /// A shape of the robot and a part of an obstacle, with the part placed in the frame of the shape's link.
    fn placed_pair(&self, placed: &Placed, (shape, part): Pair) -> PlacedPair<'_> {
        let own = &self.proximity.shapes[shape];
        let link = &placed.links[own.link];
        let back = |v: [f64; 3]| [0, 1, 2].map(|k| dot(link[k], v));
        let axis = |k: usize| back([0, 1, 2].map(|i| if i == k { 1.0 } else { 0.0 }));
        let part = &self.parts[part].1.shape;
        PlacedPair {
            a: match &own.body {
                Body::Convex(shape) | Body::Round(shape) => shape,
            },
            b: part,
            b_in_a: [axis(0), axis(1), axis(2), back(link[3].map(|x| -x))],
        }
    }

    /// The radii by which a pair's shapes extend beyond their `ConvexShape`.
    fn radii(&self, (shape, part): Pair) -> [f64; 2] {
        let own = &self.proximity.shapes[shape];
        let own = match own.body {
            Body::Convex(_) => 0.0,
            Body::Round(_) => own.sphere.radius,
        };
        [own, self.parts[part].1.radius]
    }

    /// The distances of some pairs, at most [`AT_ONCE`].
    fn values(&self, placed: &Placed, pairs: &[Pair], values: &mut [f64]) {
        let both = pairs.iter().map(|pair| self.placed_pair(placed, *pair));
        let both: ArrayVec<PlacedPair, AT_ONCE> = both.collect();
        across::distances(self.proximity.level, &both, values);
        for (value, pair) in values.iter_mut().zip(pairs) {
            let radii = self.radii(*pair);
            *value = (*value - radii[0] - radii[1]).max(0.0);
        }
    }

    fn witnesses(&self, placed: &Placed, pairs: &[Pair]) -> Vec<ObstacleDistance> {
        let both = pairs.iter().map(|pair| self.placed_pair(placed, *pair));
        let both: Vec<PlacedPair> = both.collect();
        let found = across::witnesses(self.proximity.level, &both);
        let all = pairs.iter().zip(found).map(|(&(shape, part), witness)| {
            let own = &self.proximity.shapes[shape];
            let obstacle = self.parts[part].0;
            let (distance, points) = rounded(&witness, self.radii((shape, part)));
            ObstacleDistance {
                link: self.proximity.names[own.link].clone(),
                link_idx: own.link,
                piece: own.piece,
                obstacle: self.names[obstacle].clone(),
                obstacle_idx: obstacle,
                distance,
                points: points.map(|p| to_root(&placed.links[own.link], p)),
            }
        });
        all.collect()
    }
}

/// The distance and closest points of two shapes enlarged by radii.
fn rounded(witness: &Witness, [a, b]: [f64; 2]) -> (f64, [[f64; 3]; 2]) {
    let [p, q] = witness.points;
    let between = sub(q, p);
    let length = norm(between);
    let distance = (witness.distance - a - b).max(0.0);
    if length == 0.0 {
        return (distance, [p, q]);
    }
    // Positions along the line from p to q. If the bodies overlap, the middle of their common segment.
    let along = match distance > 0.0 {
        true => [a, length - b],
        false => [0.5 * ((length - b).max(0.0) + a.min(length)); 2],
    };
    let points = along.map(|t| [0, 1, 2].map(|k| p[k] + between[k] * (t / length)));
    (distance, points)
}
