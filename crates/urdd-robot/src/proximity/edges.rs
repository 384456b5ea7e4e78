//! Motions between two configurations, checked for collisions of the robot with itself.

use urdd_geometry::vector::norm;
use urdd_kinematics::Travel;

use super::{Placed, Proximity, Workspace};
use crate::edge::{Checked, EdgeSettings, blocked};
use crate::error::RobotError;

impl Proximity {
    /// Where the straight motion from `start` to `end` is blocked by the robot itself: the part of it, from 0 to 1, at
    /// which a pair is at most [`EdgeSettings::margin`] apart. `None` if it is free.
    ///
    /// With a resolution, configurations along the motion are checked, the halves first, so that the answer need not be
    /// the first part that is blocked. Without one, the motion is proved free by conservative advancement: every
    /// distance is divided by a bound on how fast it can shrink. It then needs 0.1 mm more than the margin of pairs that
    /// move against each other, and the answer is the first part where they have less.
    ///
    /// # Errors
    /// [`RobotError::Setting`] if a setting makes no sense, or a motion needs more than a million configurations; and as
    /// [`Proximity::closest_points`].
    pub fn blocked_edge(
        &self,
        start: &[f64],
        end: &[f64],
        settings: &EdgeSettings,
    ) -> Result<Option<f64>, RobotError> {
        self.blocked_edge_with(start, end, settings, &mut Workspace::default())
    }

    /// As [`Proximity::blocked_edge`], with memory that is used again.
    ///
    /// # Errors
    /// As there.
    pub fn blocked_edge_with(
        &self,
        start: &[f64],
        end: &[f64],
        settings: &EdgeSettings,
        workspace: &mut Workspace,
    ) -> Result<Option<f64>, RobotError> {
        blocked(self, [start, end], settings, workspace)
    }

    /// The farthest point of a link's shapes from its origin, m.
    fn radius(&self, link: usize) -> f64 {
        let sphere = self.spheres[link].as_ref();
        sphere.map_or(0.0, |sphere| norm(sphere.centre) + sphere.radius)
    }
}

impl Checked for Proximity {
    type Pair = usize;

    /// Pairs of a group share its rate. Links that cannot move against each other have no margin between them.
    fn pairs(&self, margin: f64) -> impl Iterator<Item = (usize, usize)> {
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

    fn place(&self, configuration: &[f64], placed: &mut Placed) -> Result<(), RobotError> {
        Proximity::place(self, configuration, placed)?;
        self.place_centres(placed);
        Ok(())
    }

    fn travel(&self, start: &[f64], end: &[f64]) -> Result<Travel<'_>, RobotError> {
        Ok(self.motion.kinematics.travel(start, end)?)
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
