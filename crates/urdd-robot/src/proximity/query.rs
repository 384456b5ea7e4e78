//! Queries on one configuration.

use std::collections::BTreeMap;
use std::sync::Arc;

use arrayvec::ArrayVec;
use rayon::prelude::*;

use super::swept::{SweptPair, Waiting, relative};
use super::{Group, PairDistance, Proximity, Rounding};
use crate::checked::Checked;
use crate::error::RobotError;
use crate::queries::Queries;
use crate::workspace::{Placed, Workspace, with_workspace};
use urdd_geometry::convex::across::{self, AT_ONCE, PlacedPair};
use urdd_geometry::vector::{dot, norm, sub};
use urdd_kinematics::Travel;

impl Proximity {
    /// The minimum distance over all pairs, in metres; `None` if there are no pairs. The other name of
    /// [`Queries::min_distance`] for the robot's own pairs.
    ///
    /// # Errors
    /// As there.
    pub fn self_distance(&self, configuration: &[f64]) -> Result<Option<f64>, RobotError> {
        self.min_distance(configuration)
    }

    /// For each two bodies with checked pairs of shapes: the number of configurations in which any of these pairs is in
    /// contact. A link is a part of a body: of itself, or of what it is fixed to.
    ///
    /// # Errors
    /// As [`Queries::in_collision_batch`].
    pub fn contacts_of_links(
        &self,
        configurations: &[f64],
        body: impl Fn(usize) -> usize,
    ) -> Result<Vec<([usize; 2], usize)>, RobotError> {
        let rows = self.motion.rows(configurations)?;
        let found = (0..rows.count).into_par_iter().map(|k| {
            with_workspace(|Workspace { placed, .. }| {
                self.place(rows.row(k), placed)?;
                let touches = |group: &Group| self.any_touches(placed, std::slice::from_ref(group));
                Ok(self.groups.iter().map(touches).collect())
            })
        });
        let found: Vec<Vec<bool>> = found.collect::<Result<_, RobotError>>()?;
        let mut parts: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for (at, group) in self.groups.iter().enumerate() {
            let mut bodies = group.links.map(&body);
            bodies.sort_unstable();
            parts.entry(bodies).or_default().push(at);
        }
        let count = |parts: &[usize]| {
            let touches = |one: &&Vec<bool>| parts.iter().any(|at| one[*at]);
            found.iter().filter(touches).count()
        };
        Ok(parts.into_iter().map(|(bodies, parts)| (bodies, count(&parts))).collect())
    }

    /// The radius of the bounding sphere of a link's shapes, m.
    pub(crate) fn around(&self, link: usize) -> f64 {
        self.spheres[link].map_or(0.0, |sphere| sphere.radius)
    }

    /// Whether any pair in these groups touches, for the given placement of the links.
    pub(crate) fn any_touches(&self, placed: &Placed, groups: &[Group]) -> bool {
        let mut waiting = Waiting::new(self.level);
        for group in groups {
            let [a, b] = group.links;
            let (other, radius) = (placed.around[b], self.around(b));
            if are_apart(placed.around[a], other, self.around(a) + radius) {
                continue;
            }
            let pose = relative(&placed.links[a], &placed.links[b]);
            // Whether the first shape of the last pair is near the other link.
            let mut last = (usize::MAX, false);
            for pair in group.first..group.end {
                let [i, j] = self.pairs[pair].shapes;
                let (p, reach) = (placed.centres[i], self.shapes[i].sphere.radius);
                if last.0 != i {
                    last = (i, !are_apart(p, other, reach + radius));
                }
                // Most pairs are told apart without a square root.
                let is_near = last.1
                    && !are_apart(p, placed.centres[j], reach + self.shapes[j].sphere.radius);
                if !is_near || self.bound(placed, pair) > 0.0 {
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

    /// The pose of the second shape's link in the frame of the first one's.
    fn pose(&self, placed: &Placed, pair: usize) -> [[f64; 3]; 4] {
        let [a, b] = self.pairs[pair].shapes.map(|shape| &placed.links[self.shapes[shape].link]);
        relative(a, b)
    }

    /// Whether a pair is two balls: the bound of their distance is the distance.
    fn are_balls(&self, pair: usize) -> bool {
        let [a, b] = self.pairs[pair].shapes;
        self.shapes[a].is_ball && self.shapes[b].is_ball
    }

    fn cores(&self, pair: usize, b_in_a: [[f64; 3]; 4]) -> PlacedPair<'_> {
        let [a, b] = self.pairs[pair].shapes;
        PlacedPair { a: &self.shapes[a].core, b: &self.shapes[b].core, b_in_a }
    }

    fn radii(&self, pair: usize) -> f64 {
        let [a, b] = self.pairs[pair].shapes;
        self.shapes[a].radius + self.shapes[b].radius
    }

    /// The farthest point of a link's shapes from its origin, m.
    fn radius(&self, link: usize) -> f64 {
        let sphere = self.spheres[link].as_ref();
        sphere.map_or(0.0, |sphere| norm(sphere.centre) + sphere.radius)
    }
}

/// Whether two spheres are disjoint, from the sum of their radii.
fn are_apart(p: [f64; 3], q: [f64; 3], reach: f64) -> bool {
    let between = sub(q, p);
    dot(between, between) > reach * reach * (1.0 + 1e-12)
}

impl Checked for Proximity {
    type Pair = PairDistance;
    const BLOCK: usize = 32;

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

    fn num_groups(&self) -> usize {
        self.groups.len()
    }

    fn group_bound(&self, placed: &Placed, group: usize) -> f64 {
        let [a, b] = self.groups[group].links;
        let apart = norm(sub(placed.around[b], placed.around[a]));
        // Less by more than any rounding error.
        apart * (1.0 - 1e-12) - (self.around(a) + self.around(b)) * (1.0 + 1e-12) - 1e-12
    }

    fn members(&self, group: usize) -> impl Iterator<Item = usize> {
        let Group { first, end, .. } = self.groups[group];
        first..end
    }

    fn counts(&self, group: usize, margin: f64) -> bool {
        self.groups[group].moves || margin == 0.0
    }

    fn bound(&self, placed: &Placed, pair: usize) -> f64 {
        let [a, b] = self.pairs[pair].shapes;
        let apart = norm(sub(placed.centres[b], placed.centres[a]));
        apart - self.shapes[a].sphere.radius - self.shapes[b].sphere.radius
    }

    fn values(&self, placed: &Placed, pairs: &[usize], values: &mut [f64]) {
        if self.rounding != Rounding::Balls {
            let cores = pairs.iter().map(|pair| self.cores(*pair, self.pose(placed, *pair)));
            let cores: ArrayVec<PlacedPair, AT_ONCE> = cores.collect();
            across::distances(self.level, &cores, values);
        }
        if self.rounding == Rounding::None {
            return;
        }
        for (value, pair) in values.iter_mut().zip(pairs) {
            *value = match self.are_balls(*pair) {
                true => self.bound(placed, *pair).max(0.0),
                false => (*value - self.radii(*pair)).max(0.0),
            };
        }
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
            true => self.bound(placed, pair).max(0.0),
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
        let of =
            |link: usize| travel.of_points(link, self.radius(link), self.motion.kinematics.root());
        links.map(of).fold(0.0, f64::max)
    }
}
