//! Queries on one configuration.

use std::sync::Arc;

use arrayvec::ArrayVec;

use super::swept::{SweptPair, Waiting};
use super::workspace::{Placed, Workspace};
use super::{Gradient, Group, Overlap, PairDistance, Proximity, Rounding};
use crate::batch::check_room;
use crate::checked::{Checked, closest, least};
use crate::edge::{EdgeSettings, FirstContact};
use crate::error::RobotError;
use crate::questions::questions;
use urdd_geometry::convex::across::{self, AT_ONCE, PlacedPair};
use urdd_geometry::vector::norm;
use urdd_kinematics::Travel;

impl Proximity {
    /// The distance and the closest points of each pair that is checked, in the order of [`Proximity::pairs`].
    /// `configuration` has one value for each DOF, rad or m; values beyond the bounds are allowed.
    ///
    /// # Errors
    /// [`RobotError::Configuration`] if the length differs from the number of DOFs or a value is not finite.
    pub fn closest_points(&self, configuration: &[f64]) -> Result<Vec<PairDistance>, RobotError> {
        let placed = self.placed(configuration)?;
        Ok(self.witnesses(&placed, 0..self.pairs.len()))
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
        let mut pairs = [0; AT_ONCE];
        for (chunk, out) in out.chunks_mut(AT_ONCE).enumerate() {
            for (k, pair) in pairs.iter_mut().enumerate() {
                *pair = chunk * AT_ONCE + k;
            }
            self.values(placed, &pairs[..out.len()], out);
        }
        Ok(())
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
        let nearest = least(self, configuration, 1, workspace)?;
        Ok(nearest.first().map(|(distance, _)| *distance))
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
        Ok(self.witnesses(&placed, touching))
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

    /// The farthest point of a link's shapes from its origin, m.
    fn radius(&self, link: usize) -> f64 {
        let sphere = self.spheres[link].as_ref();
        sphere.map_or(0.0, |sphere| norm(sphere.centre) + sphere.radius)
    }

    fn witnesses(
        &self,
        placed: &Placed,
        pairs: impl IntoIterator<Item = usize>,
    ) -> Vec<PairDistance> {
        let mut all = Vec::new();
        closest(self, placed, pairs, |pair, distance, points| {
            all.push(self.found(placed, pair, distance, points));
        });
        all
    }
}

impl Checked for Proximity {
    type Found = PairDistance;

    fn shapes(&self) -> &Proximity {
        self
    }

    fn count(&self) -> usize {
        self.pairs.len()
    }

    /// Pairs of a group share its rate. Links that cannot move against each other have no margin between them.
    fn within(&self, margin: f64) -> impl Iterator<Item = (usize, usize)> {
        let groups = self.groups.iter().enumerate();
        let groups = groups.filter(move |(_, group)| group.moves || margin == 0.0);
        groups.flat_map(|(place, group)| (group.first..group.end).map(move |pair| (pair, place)))
    }

    fn bound(&self, placed: &Placed, pair: usize) -> f64 {
        Proximity::bound(self, placed, pair)
    }

    fn values(&self, placed: &Placed, pairs: &[usize], values: &mut [f64]) {
        Proximity::values(self, placed, pairs, values);
    }

    fn touches(&self, placed: &Placed) -> bool {
        self.any_touches(placed, &self.groups)
    }

    fn swept(&self, placed: &Placed, pair: usize) -> SweptPair<'_> {
        let shapes = self.pairs[pair].shapes.map(|shape| &self.shapes[shape]);
        let cores = self.cores(pair, self.pose(placed, pair));
        SweptPair { cores, radii: shapes.map(|shape| shape.radius) }
    }

    fn links(&self, pair: usize) -> (usize, Option<usize>) {
        let [a, b] = self.pairs[pair].shapes.map(|shape| self.shapes[shape].link);
        (a, Some(b))
    }

    fn found(
        &self,
        placed: &Placed,
        pair: usize,
        distance: f64,
        points: [[f64; 3]; 2],
    ) -> PairDistance {
        let shapes = self.pairs[pair].shapes.map(|shape| &self.shapes[shape]);
        let distance = match self.are_balls(pair) {
            true => Proximity::bound(self, placed, pair).max(0.0),
            false => distance,
        };
        PairDistance {
            links: shapes.map(|shape| Arc::clone(self.owner(shape))),
            link_idxs: shapes.map(|shape| shape.link),
            body_idxs: shapes.map(|shape| shape.owner),
            pieces: shapes.map(|shape| shape.piece),
            distance,
            relative: self.pairs[pair].mean.map(|mean| distance / mean),
            points,
        }
    }

    /// One for each group.
    fn rates(&self, travel: &Travel) -> Vec<f64> {
        let rate = |links: [usize; 2]| {
            let above = travel.common(links[0], links[1]);
            let of = |link: usize| travel.of_points(link, self.radius(link), above);
            of(links[0]) + of(links[1])
        };
        self.groups.iter().map(|group| rate(group.links)).collect()
    }

    fn farthest(&self, travel: &Travel) -> f64 {
        let links = self.groups.iter().flat_map(|group| group.links);
        let of = |link: usize| travel.of_points(link, self.radius(link), self.root());
        links.map(of).fold(0.0, f64::max)
    }
}

questions! { PairDistance, impl Proximity }
