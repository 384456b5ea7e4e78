//! Queries on one configuration.

use arrayvec::ArrayVec;

use super::body::Body;
use super::vector::to_root;
use super::workspace::{Placed, Workspace};
use super::{Group, PairDistance, Proximity};
use crate::batch::check_room;
use crate::error::RobotError;
use urdd_geometry::convex::across::{self, AT_ONCE, PlacedPair};
use urdd_geometry::vector::{norm, sub};

impl Proximity {
    /// The distance and the closest points of each pair that is checked, in the order of [`Proximity::pairs`].
    /// `configuration` has one value for each DOF, rad or m; values beyond the bounds are allowed.
    ///
    /// # Errors
    /// [`RobotError::Configuration`] if the length differs from the number of DOFs or a value is not finite.
    pub fn closest_points(&self, configuration: &[f64]) -> Result<Vec<PairDistance>, RobotError> {
        let mut placed = Placed::default();
        self.place(configuration, &mut placed)?;
        self.place_centres(&mut placed);
        let all: Vec<usize> = (0..self.pairs.len()).collect();
        Ok(self.witnesses(&placed, &all))
    }

    /// The distance of each pair that is checked, in metres, in the order of [`Proximity::pairs`].
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn distances(&self, configuration: &[f64]) -> Result<Vec<f64>, RobotError> {
        let mut values = vec![0.0; self.pairs.len()];
        self.distances_with(configuration, &mut Workspace::default(), &mut values)?;
        Ok(values)
    }

    /// As [`Proximity::distances`], into `out`, with memory that is used again: it does not allocate.
    ///
    /// # Errors
    /// As there, and [`RobotError::Room`] if the length of `out` differs from the number of pairs.
    pub fn distances_with(
        &self,
        configuration: &[f64],
        workspace: &mut Workspace,
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        check_room(out.len(), 1, self.pairs.len())?;
        let placed = &mut workspace.placed;
        self.place(configuration, placed)?;
        self.place_centres(placed);
        let mut pairs = [0; AT_ONCE];
        for (chunk, out) in out.chunks_mut(AT_ONCE).enumerate() {
            for (k, pair) in pairs.iter_mut().enumerate() {
                *pair = chunk * AT_ONCE + k;
            }
            self.values(placed, &pairs[..out.len()], out);
        }
        Ok(())
    }

    /// The `k` nearest pairs, nearest first; all pairs if there are fewer. Ties are in the order of
    /// [`Proximity::pairs`].
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn nearest(
        &self,
        configuration: &[f64],
        k: usize,
    ) -> Result<Vec<PairDistance>, RobotError> {
        let mut workspace = Workspace::default();
        let nearest = self.least(configuration, k, &mut workspace)?;
        let pairs: Vec<usize> = nearest.iter().map(|(_, pair)| *pair).collect();
        Ok(self.witnesses(&workspace.placed, &pairs))
    }

    /// The minimum distance over all pairs, in metres; `None` if there are no pairs.
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn self_distance(&self, configuration: &[f64]) -> Result<Option<f64>, RobotError> {
        self.self_distance_with(configuration, &mut Workspace::default())
    }

    /// As [`Proximity::self_distance`], with memory that is used again: it does not allocate.
    ///
    /// # Errors
    /// As there.
    pub fn self_distance_with(
        &self,
        configuration: &[f64],
        workspace: &mut Workspace,
    ) -> Result<Option<f64>, RobotError> {
        let least = self.least(configuration, 1, workspace)?;
        Ok(least.first().map(|(distance, _)| *distance))
    }

    /// Whether any pair touches or overlaps, that is, has distance 0. Stops at the first collision.
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn in_collision(&self, configuration: &[f64]) -> Result<bool, RobotError> {
        self.in_collision_with(configuration, &mut Workspace::default())
    }

    /// As [`Proximity::in_collision`], with memory that is used again: it does not allocate.
    ///
    /// # Errors
    /// As there.
    pub fn in_collision_with(
        &self,
        configuration: &[f64],
        workspace: &mut Workspace,
    ) -> Result<bool, RobotError> {
        let placed = &mut workspace.placed;
        self.place(configuration, placed)?;
        self.place_centres(placed);
        Ok(self.any_touches(placed, &self.groups))
    }

    /// The pairs that touch or overlap, in the order of [`Proximity::pairs`].
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn collisions(&self, configuration: &[f64]) -> Result<Vec<PairDistance>, RobotError> {
        let mut placed = Placed::default();
        self.place(configuration, &mut placed)?;
        self.place_centres(&mut placed);
        let near = (0..self.pairs.len()).filter(|pair| self.bound(&placed, *pair) <= 0.0);
        let near: Vec<usize> = near.collect();
        let mut touching = Vec::new();
        for pairs in near.chunks(AT_ONCE) {
            let mut values = [0.0; AT_ONCE];
            self.values(&placed, pairs, &mut values[..pairs.len()]);
            let both = pairs.iter().zip(values);
            touching.extend(
                both.filter(|(_, value)| *value == 0.0)
                    .map(|(pair, _)| *pair),
            );
        }
        Ok(self.witnesses(&placed, &touching))
    }

    /// Whether any pair in these groups touches, for the given placement of the links.
    pub(super) fn any_touches(&self, placed: &Placed, groups: &[Group]) -> bool {
        let mut near: ArrayVec<PlacedPair, AT_ONCE> = ArrayVec::new();
        for group in groups {
            if self.are_apart(placed, group.links) {
                continue;
            }
            let pose = Self::relative(placed, group.links[0], group.links[1]);
            for pair in group.first..group.end {
                if self.bound(placed, pair) > 0.0 {
                    continue;
                }
                let Some(pair) = self.convex(pair, pose) else {
                    return true;
                };
                near.push(pair);
                if near.len() == AT_ONCE {
                    if across::any_touches(self.level, &near) {
                        return true;
                    }
                    near.clear();
                }
            }
        }
        across::any_touches(self.level, &near)
    }

    /// The distances and indices of the `k` nearest pairs, nearest first.
    pub(super) fn least<'a>(
        &self,
        configuration: &[f64],
        k: usize,
        workspace: &'a mut Workspace,
    ) -> Result<&'a [(f64, usize)], RobotError> {
        let Workspace { placed, least, .. } = workspace;
        self.place(configuration, placed)?;
        self.place_centres(placed);
        let bounds = (0..self.pairs.len()).map(|pair| (self.bound(placed, pair), pair));
        Ok(least.of(bounds, k, |pairs, values| {
            self.values(placed, pairs, values);
        }))
    }

    /// The distances of some pairs, at most [`AT_ONCE`].
    fn values(&self, placed: &Placed, pairs: &[usize], values: &mut [f64]) {
        let mut convex: ArrayVec<PlacedPair, AT_ONCE> = ArrayVec::new();
        for pair in pairs {
            convex.extend(self.convex(*pair, self.pose(placed, *pair)));
        }
        if convex.len() == pairs.len() {
            across::distances(self.level, &convex, values);
        } else {
            // For spheres, the bound is the distance.
            for (value, pair) in values.iter_mut().zip(pairs) {
                *value = self.bound(placed, *pair).max(0.0);
            }
        }
    }

    fn pose(&self, placed: &Placed, pair: usize) -> [[f64; 3]; 4] {
        let [a, b] = self.pairs[pair].shapes.map(|shape| self.shapes[shape].link);
        Self::relative(placed, a, b)
    }

    /// The two shapes of a pair; `None` for spheres.
    fn convex(&self, pair: usize, b_in_a: [[f64; 3]; 4]) -> Option<PlacedPair<'_>> {
        let [a, b] = self.pairs[pair]
            .shapes
            .map(|shape| &self.shapes[shape].body);
        match (a, b) {
            (Body::Convex(a), Body::Convex(b)) => Some(PlacedPair { a, b, b_in_a }),
            _ => None,
        }
    }

    fn witnesses(&self, placed: &Placed, pairs: &[usize]) -> Vec<PairDistance> {
        let convex: Vec<PlacedPair> = pairs
            .iter()
            .filter_map(|pair| self.convex(*pair, self.pose(placed, *pair)))
            .collect();
        let found: Vec<(f64, [[f64; 3]; 2])> = if convex.len() == pairs.len() {
            let witnesses = across::witnesses(self.level, &convex);
            let both = pairs.iter().zip(witnesses);
            both.map(|(pair, found)| {
                let link = self.shapes[self.pairs[*pair].shapes[0]].link;
                let root = |p| to_root(&placed.links[link], p);
                (found.distance, found.points.map(root))
            })
            .collect()
        } else {
            pairs
                .iter()
                .map(|pair| self.of_spheres(placed, *pair))
                .collect()
        };
        let both = pairs.iter().zip(found);
        both.map(|(pair, (distance, points))| self.pair_distance(*pair, distance, points))
            .collect()
    }

    fn pair_distance(&self, pair: usize, distance: f64, points: [[f64; 3]; 2]) -> PairDistance {
        let pair = &self.pairs[pair];
        let shapes = pair.shapes.map(|shape| &self.shapes[shape]);
        PairDistance {
            links: shapes.map(|shape| self.names[shape.link].clone()),
            link_idxs: shapes.map(|shape| shape.link),
            pieces: shapes.map(|shape| shape.piece),
            distance,
            relative: pair.mean.map(|mean| distance / mean),
            points,
        }
    }

    /// The distance of two spheres, and their closest points.
    fn of_spheres(&self, placed: &Placed, pair: usize) -> (f64, [[f64; 3]; 2]) {
        let [a, b] = self.pairs[pair].shapes;
        let (p, q) = (placed.centres[a], placed.centres[b]);
        let radii = [a, b].map(|shape| self.shapes[shape].sphere.radius);
        let between = sub(q, p);
        let length = norm(between);
        let distance = (length - radii[0] - radii[1]).max(0.0);
        let toward = match length > 0.0 {
            true => between.map(|x| x / length),
            false => [1.0, 0.0, 0.0],
        };
        // If the spheres overlap: a point on the line between the centres that is in both.
        let along = match distance > 0.0 {
            true => [radii[0], length - radii[1]],
            false => [radii[0].min(0.5 * (length + radii[0] - radii[1]).max(0.0)); 2],
        };
        (
            distance,
            along.map(|t| [0, 1, 2].map(|k| p[k] + t * toward[k])),
        )
    }
}
