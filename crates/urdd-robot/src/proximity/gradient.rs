//! Gradients of distances with respect to the configuration.

use nalgebra::Isometry3;

use super::swept::penetration_of;
use super::vector::to_root;
use super::{PairDistance, Proximity, Workspace};
use crate::error::RobotError;
use urdd_geometry::convex::Penetration;
use urdd_geometry::vector::{norm, sub};

/// The distance of a pair, and how it changes with the configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct PairGradient {
    /// The pair, its distance and its closest points.
    pub pair: PairDistance,
    /// The derivative of the distance for each DOF, m/rad or m/m. `None` if the shapes touch or overlap, where the
    /// distance is 0 and has no gradient.
    ///
    /// It is that of the closest points as they are: n (J_b - J_a), with the unit vector n from the first point to the
    /// second, and the Jacobians of the two points. Where other points are as close (parallel faces, edges), the
    /// distance is not differentiable, and this is one of its directional derivatives.
    pub gradient: Option<Vec<f64>>,
}

/// Two shapes that touch or overlap.
#[derive(Debug, Clone, PartialEq)]
pub struct Overlap<P> {
    /// The pair. Its distance is 0; its points are those that touch once the second shape has moved, before it moves.
    pub pair: P,
    /// The length of the least translation that separates the two, m; 0 if they touch.
    pub depth: f64,
    /// The unit vector, in the root link's frame, along which the second shape would move.
    pub direction: [f64; 3],
    /// The derivative of the depth for each DOF, m/rad or m/m, of the two points as they are. Where another translation is
    /// as short, the depth is not differentiable, and this is one of its directional derivatives.
    pub gradient: Vec<f64>,
}

impl Proximity {
    /// The `k` nearest pairs, nearest first, with the gradients of their distances.
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn gradients(
        &self,
        configuration: &[f64],
        k: usize,
    ) -> Result<Vec<PairGradient>, RobotError> {
        let mut workspace = Workspace::default();
        let nearest = self.least(configuration, k, &mut workspace)?;
        let pairs: Vec<usize> = nearest.iter().map(|(_, pair)| *pair).collect();
        let poses = &workspace.placed.poses;
        let of = |pair: PairDistance| {
            let [a, b] = pair.link_idxs;
            let gradient = toward(&pair.points, pair.distance).map(|toward| {
                let speeds = |link: usize, point: usize| {
                    self.speeds(configuration, poses, link, pair.points[point], toward)
                };
                let each = speeds(a, 0).into_iter().zip(speeds(b, 1));
                each.map(|(a, b)| b - a).collect()
            });
            PairGradient { pair, gradient }
        };
        let found = self.witnesses(&workspace.placed, &pairs);
        Ok(found.into_iter().map(of).collect())
    }

    /// The pairs that touch or overlap, in the order of [`Proximity::pairs`], with how far they do.
    ///
    /// # Errors
    /// As [`Proximity::closest_points`].
    pub fn penetrations(
        &self,
        configuration: &[f64],
    ) -> Result<Vec<Overlap<PairDistance>>, RobotError> {
        let placed = self.placed(configuration)?;
        let near = (0..self.pairs.len()).filter(|pair| self.bound(&placed, *pair) <= 0.0);
        let overlap = |place: usize| {
            let swept = self.swept(place, self.pose(&placed, place));
            let found = penetration_of(self.level, &swept)?;
            let [a, b] = self.pairs[place].shapes.map(|shape| self.shapes[shape].link);
            let (direction, points) = in_root(&placed.links[a], &found);
            let speeds = |link: usize, point: [f64; 3]| {
                self.speeds(configuration, &placed.poses, link, point, direction)
            };
            let each = speeds(a, points[0]).into_iter().zip(speeds(b, points[1]));
            Some(Overlap {
                pair: self.pair_distance(place, 0.0, points),
                depth: found.depth,
                direction,
                gradient: each.map(|(a, b)| a - b).collect(),
            })
        };
        Ok(near.filter_map(overlap).collect())
    }

    /// How fast a point of a link, in the root link's frame, moves in a direction with each DOF, m/rad or m/m.
    pub(crate) fn speeds(
        &self,
        configuration: &[f64],
        poses: &[Isometry3<f64>],
        link: usize,
        point: [f64; 3],
        direction: [f64; 3],
    ) -> Vec<f64> {
        let mut jacobian = vec![0.0; 6 * self.num_dofs()];
        let kinematics = &self.motion.kinematics;
        kinematics.jacobian_into(configuration, poses, link, &point.into(), &mut jacobian);
        let columns = jacobian.chunks_exact(6);
        let speed = |column: &[f64]| (0..3).map(|k| direction[k] * column[k]).sum();
        columns.map(speed).collect()
    }
}

/// The direction and the points of a penetration in the root link's frame, from the frame of a link.
pub(crate) fn in_root(link: &[[f64; 3]; 4], found: &Penetration) -> ([f64; 3], [[f64; 3]; 2]) {
    let turned = [link[0], link[1], link[2], [0.0; 3]];
    let points = found.points.map(|p| to_root(link, p));
    (to_root(&turned, found.direction), points)
}

/// The unit vector from the first of two closest points to the second; `None` if the shapes touch or overlap.
pub(crate) fn toward(points: &[[f64; 3]; 2], distance: f64) -> Option<[f64; 3]> {
    let between = sub(points[1], points[0]);
    let length = norm(between);
    (distance > 0.0).then(|| between.map(|x| x / length))
}
