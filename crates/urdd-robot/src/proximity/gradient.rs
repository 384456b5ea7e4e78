//! Gradients of distances with respect to the configuration.

use super::body::to_root;
use super::{PairDistance, Proximity};
use crate::workspace::{Derivative, Placed};
use urdd_geometry::convex::Penetration;
use urdd_geometry::vector::{norm, sub};

/// The distance of a pair, and how it changes with the configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient<P> {
    /// The pair, its distance and its closest points.
    pub pair: P,
    /// The derivative of the distance for each DOF, m/rad or m/m. `None` if the shapes touch or overlap, where the
    /// distance is 0 and has no gradient.
    ///
    /// It is that of the closest points as they are: n (J_b - J_a), with the unit vector n from the first point to the
    /// second, and the Jacobians of the two points. Where other points are as close (parallel faces, edges), the
    /// distance is not differentiable, and this is one of its directional derivatives.
    pub gradient: Option<Vec<f64>>,
}

/// The distance of a pair of the robot's shapes, and how it changes.
pub type PairGradient = Gradient<PairDistance>;

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
    /// How fast two points of links, in the root link's frame, come apart in a direction with each DOF, m/rad or m/m.
    /// Without a second link, the second point stays.
    pub(crate) fn derivative<'a>(
        &self,
        configuration: &[f64],
        placed: &Placed,
        (a, b): (usize, Option<usize>),
        points: [[f64; 3]; 2],
        direction: [f64; 3],
        memory: &'a mut Derivative,
    ) -> &'a [f64] {
        let kinematics = &self.motion.kinematics;
        let dofs = kinematics.num_dofs();
        memory.jacobian.resize(6 * dofs, 0.0);
        memory.of_dofs.clear();
        memory.of_dofs.resize(dofs, 0.0);
        for (link, point, sign) in [(Some(a), points[0], -1.0), (b, points[1], 1.0)] {
            let Some(link) = link else { continue };
            let (poses, jacobian) = (&placed.poses, &mut memory.jacobian);
            kinematics.jacobian_into(configuration, poses, link, &point.into(), jacobian);
            for (sum, column) in memory.of_dofs.iter_mut().zip(jacobian.chunks_exact(6)) {
                let speed: f64 = (0..3).map(|k| direction[k] * column[k]).sum();
                *sum += sign * speed;
            }
        }
        &memory.of_dofs
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
