//! Gradients of distances to obstacles, and how far they overlap.

use std::ops::Deref;

use super::proximity::{ObstacleDistance, Pair, WorldProximity};
use crate::error::RobotError;
use crate::proximity::{Overlap, Proximity, in_root, penetration_of, toward};

/// The distance between a shape of the robot and an obstacle, and how it changes with the configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct ObstacleGradient {
    /// The pair, its distance and its closest points.
    pub pair: ObstacleDistance,
    /// The derivative of the distance for each DOF, m/rad or m/m, as in
    /// [`PairGradient`](crate::PairGradient::gradient). `None` if the two touch or overlap.
    pub gradient: Option<Vec<f64>>,
}

impl<P: Deref<Target = Proximity>> WorldProximity<P> {
    /// The `k` nearest pairs of a shape of the robot and a part of an obstacle, nearest first, with the gradients of their
    /// distances.
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn gradients(
        &self,
        configuration: &[f64],
        k: usize,
    ) -> Result<Vec<ObstacleGradient>, RobotError> {
        let placed = self.place(configuration)?;
        let of = |found: ObstacleDistance| {
            let gradient = toward(&found.points, found.distance).map(|toward| {
                let (link, point) = (found.link_idx, found.points[0]);
                let away = toward.map(|x| -x);
                self.proximity.speeds(configuration, &placed.poses, link, point, away)
            });
            ObstacleGradient { pair: found, gradient }
        };
        let nearest = self.least(&placed, self.tested(), k);
        Ok(nearest.into_iter().map(of).collect())
    }

    /// The pairs of a shape of the robot and a part of an obstacle that touch or overlap, with how far they do.
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn penetrations(
        &self,
        configuration: &[f64],
    ) -> Result<Vec<Overlap<ObstacleDistance>>, RobotError> {
        let placed = self.place(configuration)?;
        let near = self.tested().filter(|pair| self.bound(&placed, *pair) <= 0.0);
        let overlap = |pair: Pair| {
            let found = penetration_of(self.proximity.level, &self.swept(&placed, pair))?;
            let link = self.proximity.shapes[pair.0].link;
            let (direction, points) = in_root(&placed.links[link], &found);
            let poses = &placed.poses;
            Some(Overlap {
                pair: self.obstacle_distance(pair, 0.0, points),
                depth: found.depth,
                direction,
                gradient: self.proximity.speeds(configuration, poses, link, points[0], direction),
            })
        };
        Ok(near.filter_map(overlap).collect())
    }
}
