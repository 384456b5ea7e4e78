//! Queries on one configuration.

use std::sync::Arc;

use arrayvec::ArrayVec;

use super::swept::{self, SweptPair, Waiting};
use super::vector::to_root;
use super::workspace::{Placed, Workspace};
use super::{Group, PairDistance, Proximity, Rounding};
use crate::batch::check_room;
use crate::error::RobotError;
use urdd_geometry::convex::across::{self, AT_ONCE, PlacedPair};

impl Proximity {
    /// The distance and the closest points of each pair that is checked, in the order of [`Proximity::pairs`].
    /// `configuration` has one value for each DOF, rad or m; values beyond the bounds are allowed.
    ///
    /// # Errors
    /// [`RobotError::Configuration`] if the length differs from the number of DOFs or a value is not finite.
    pub fn closest_points(&self, configuration: &[f64]) -> Result<Vec<PairDistance>, RobotError> {
        let placed = self.placed(configuration)?;
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
        let placed = self.placed(configuration)?;
        let near = (0..self.pairs.len()).filter(|pair| self.bound(&placed, *pair) <= 0.0);
        let near: Vec<usize> = near.collect();
        let mut touching = Vec::new();
        for pairs in near.chunks(AT_ONCE) {
            let mut values = [0.0; AT_ONCE];
            self.values(&placed, pairs, &mut values[..pairs.len()]);
            let both = pairs.iter().zip(values);
            touching.extend(both.filter(|(_, value)| *value == 0.0).map(|(pair, _)| *pair));
        }
        Ok(self.witnesses(&placed, &touching))
    }

    /// Whether any pair in these groups touches, for the given placement of the links.
    pub(super) fn any_touches(&self, placed: &Placed, groups: &[Group]) -> bool {
        let mut waiting = Waiting::new(self.level);
        for group in groups {
            if self.are_apart(placed, group.links) {
                continue;
            }
            let pose = Self::relative(placed, group.links[0], group.links[1]);
            for pair in group.first..group.end {
                if self.bound(placed, pair) > 0.0 {
                    continue;
                }
                // The bound of balls is their distance.
                if self.rounding != Rounding::None && self.are_balls(pair) {
                    return true;
                }
                if waiting.touches_with(self.cores(pair, pose), self.radii(pair)) {
                    return true;
                }
            }
        }
        waiting.any_touches()
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
    pub(super) fn values(&self, placed: &Placed, pairs: &[usize], values: &mut [f64]) {
        if self.rounding != Rounding::Balls {
            let cores = pairs.iter();
            let cores = cores.map(|pair| self.cores(*pair, self.pose(placed, *pair)));
            let cores: ArrayVec<PlacedPair, AT_ONCE> = cores.collect();
            across::distances(self.level, &cores, values);
        }
        if self.rounding == Rounding::None {
            return;
        }
        for (value, pair) in values.iter_mut().zip(pairs) {
            *value = self.rounded(placed, *pair, *value);
        }
    }

    /// The distance of a pair, from that of its cores.
    fn rounded(&self, placed: &Placed, pair: usize, cores: f64) -> f64 {
        match self.are_balls(pair) {
            true => self.bound(placed, pair).max(0.0),
            false => (cores - self.radii(pair)).max(0.0),
        }
    }

    pub(super) fn pose(&self, placed: &Placed, pair: usize) -> [[f64; 3]; 4] {
        let [a, b] = self.pairs[pair].shapes.map(|shape| self.shapes[shape].link);
        Self::relative(placed, a, b)
    }

    /// Whether a pair is two balls: the bound of their distance is the distance.
    fn are_balls(&self, pair: usize) -> bool {
        let [a, b] = self.pairs[pair].shapes;
        self.shapes[a].is_ball && self.shapes[b].is_ball
    }

    /// The cores of a pair.
    fn cores(&self, pair: usize, b_in_a: [[f64; 3]; 4]) -> PlacedPair<'_> {
        let [a, b] = self.pairs[pair].shapes;
        PlacedPair { a: &self.shapes[a].core, b: &self.shapes[b].core, b_in_a }
    }

    /// The sum of the radii of a pair.
    fn radii(&self, pair: usize) -> f64 {
        let [a, b] = self.pairs[pair].shapes;
        self.shapes[a].radius + self.shapes[b].radius
    }

    /// The two shapes of a pair.
    pub(super) fn swept(&self, pair: usize, b_in_a: [[f64; 3]; 4]) -> SweptPair<'_> {
        let [a, b] = self.pairs[pair].shapes;
        SweptPair {
            cores: self.cores(pair, b_in_a),
            radii: [self.shapes[a].radius, self.shapes[b].radius],
        }
    }

    pub(super) fn witnesses(&self, placed: &Placed, pairs: &[usize]) -> Vec<PairDistance> {
        let both = pairs.iter();
        let swept = both.map(|pair| self.swept(*pair, self.pose(placed, *pair)));
        let found = swept::witnesses(self.level, &swept.collect::<Vec<_>>());
        let both = pairs.iter().zip(found);
        both.map(|(pair, (distance, points))| {
            let link = self.shapes[self.pairs[*pair].shapes[0]].link;
            let points = points.map(|p| to_root(&placed.links[link], p));
            let distance = match self.are_balls(*pair) {
                true => self.bound(placed, *pair).max(0.0),
                false => distance,
            };
            self.pair_distance(*pair, distance, points)
        })
        .collect()
    }

    pub(super) fn pair_distance(
        &self,
        pair: usize,
        distance: f64,
        points: [[f64; 3]; 2],
    ) -> PairDistance {
        let shapes = self.pairs[pair].shapes.map(|shape| &self.shapes[shape]);
        PairDistance {
            links: shapes.map(|shape| Arc::clone(self.owner(shape))),
            link_idxs: shapes.map(|shape| shape.link),
            pieces: shapes.map(|shape| shape.piece),
            distance,
            relative: self.pairs[pair].mean.map(|mean| distance / mean),
            points,
        }
    }
}
