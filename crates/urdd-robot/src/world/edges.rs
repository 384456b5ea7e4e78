//! Motions between two configurations, checked for collisions with obstacles.

use std::ops::Deref;

use urdd_geometry::vector::norm;
use urdd_kinematics::Travel;

use super::proximity::{Pair, WorldProximity};
use crate::edge::{Checked, EdgeSettings, any_within, blocked, check_margin};
use crate::error::RobotError;
use crate::proximity::{Placed, Proximity, Workspace};

impl<P: Deref<Target = Proximity>> WorldProximity<P> {
    /// Whether any shape of the robot is at most `margin` from an obstacle, m. Stops at the first such pair.
    ///
    /// # Errors
    /// [`RobotError::Setting`] if the margin is negative or not finite; and as [`Proximity::closest_points`].
    pub fn is_within(&self, configuration: &[f64], margin: f64) -> Result<bool, RobotError> {
        self.is_within_with(configuration, margin, &mut Workspace::default())
    }

    /// As [`WorldProximity::is_within`], with memory that is used again: it does not allocate.
    ///
    /// # Errors
    /// As there.
    pub fn is_within_with(
        &self,
        configuration: &[f64],
        margin: f64,
        workspace: &mut Workspace,
    ) -> Result<bool, RobotError> {
        check_margin(margin)?;
        self.place_into(configuration, &mut workspace.placed)?;
        Ok(any_within(self, &workspace.placed, margin))
    }

    /// Where the straight motion from `start` to `end` is blocked by an obstacle: as [`Proximity::blocked_edge`].
    ///
    /// # Errors
    /// As there.
    pub fn blocked_edge(
        &self,
        start: &[f64],
        end: &[f64],
        settings: &EdgeSettings,
    ) -> Result<Option<f64>, RobotError> {
        self.blocked_edge_with(start, end, settings, &mut Workspace::default())
    }

    /// As [`WorldProximity::blocked_edge`], with memory that is used again.
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
}

impl<P: Deref<Target = Proximity>> Checked for WorldProximity<P> {
    type Pair = Pair;

    /// Pairs of a shape of the robot share its rate.
    fn pairs(&self, _: f64) -> impl Iterator<Item = (Pair, usize)> {
        self.tested().map(|pair| (pair, pair.0))
    }

    fn bound(&self, placed: &Placed, pair: Pair) -> f64 {
        WorldProximity::bound(self, placed, pair)
    }

    fn values(&self, placed: &Placed, pairs: &[Pair], values: &mut [f64]) {
        WorldProximity::values(self, placed, pairs, values);
    }

    fn touches(&self, placed: &Placed) -> bool {
        WorldProximity::touches(self, placed)
    }

    fn place(&self, configuration: &[f64], placed: &mut Placed) -> Result<(), RobotError> {
        self.place_into(configuration, placed)
    }

    fn travel(&self, start: &[f64], end: &[f64]) -> Result<Travel<'_>, RobotError> {
        self.proximity.travel(start, end)
    }

    /// One for each shape of the robot.
    fn rates(&self, travel: &Travel) -> Vec<f64> {
        let root = self.proximity.root();
        let shapes = self.proximity.shapes.iter();
        let rate = shapes.map(|shape| {
            let radius = norm(shape.sphere.centre) + shape.sphere.radius;
            travel.of_points(shape.link, radius, root)
        });
        rate.collect()
    }

    fn farthest(&self, travel: &Travel) -> f64 {
        self.rates(travel).into_iter().fold(0.0, f64::max)
    }
}
