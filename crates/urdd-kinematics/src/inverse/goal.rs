//! What is searched for, and how exactly.

use nalgebra::{Point3, UnitQuaternion, Vector6};

/// The desired position of a point of a link, the desired rotation of the link, or both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal {
    /// Index of the link.
    pub link: usize,
    /// The point, in the link's frame, metres.
    pub point: Point3<f64>,
    /// The desired position, in the root link's frame, metres; `None` for any.
    pub position: Option<Point3<f64>>,
    /// The desired rotation of the link's frame in the root link's frame; `None` for any.
    pub rotation: Option<UnitQuaternion<f64>>,
    /// Factors of the errors along the axes of the desired rotation, or of the root link's frame without one: of the
    /// position along x, y, z, then of the rotation about x, y, z. An error whose factor is 0 is free. `None` for 1.
    pub weights: Option<[f64; 6]>,
}

impl Goal {
    /// An error, or a column of its Jacobian, times the weights.
    pub(super) fn weighted(&self, vector: &Vector6<f64>) -> Vector6<f64> {
        let Some(weights) = &self.weights else {
            return *vector;
        };
        let axes = self.rotation.unwrap_or_else(UnitQuaternion::identity);
        let part =
            |first: usize| axes.inverse_transform_vector(&vector.fixed_rows::<3>(first).into());
        let parts = [part(0), part(3)];
        Vector6::from_fn(|row, _| weights[row] * parts[row / 3][row % 3])
    }
}

/// Tolerances and limits of [`ForwardKinematics::reach`](crate::ForwardKinematics::reach).
#[derive(Debug, Clone, PartialEq)]
pub struct InverseSettings {
    /// Position tolerance, metres, 0 or more; default 1e-6.
    pub position_tolerance: f64,
    /// Rotation tolerance, radians, 0 or more; default 1e-6.
    pub rotation_tolerance: f64,
    /// Maximum number of iterations per descent, at least 1; default 100.
    pub iterations: usize,
    /// Maximum number of descents from random configurations after the first one; default 100.
    pub restarts: usize,
    /// Restart 1, 2, ... uses [`ConfigurationSpace::sampled`](crate::ConfigurationSpace::sampled) with the sum of
    /// `seed` and the restart's number. So the search is deterministic.
    pub seed: u64,
    /// Bounds of each DOF, limited or not, in place of those of `bounds_module`, lower bound first: for an unlimited
    /// base, which otherwise stays within one metre of its start, or to restrict the robot further.
    pub bounds: Option<Vec<[f64; 2]>>,
    /// DOFs that keep the value that they have in the start configuration.
    pub locked: Vec<usize>,
    /// A configuration that the solution should be near. Descents begin at the start, at the posture, then at random
    /// between the posture and anywhere, until 12 restarts in a row bring no nearer solution. Each solution is moved
    /// toward the posture as far as the goal allows, and the nearest one counts, by the Euclidean distance of the DOFs
    /// that move the link. This is a search: a nearer solution can be missed.
    pub posture: Option<Vec<f64>>,
    /// Whether to find out why a goal is not reached, which takes as long as the search; default true.
    pub explain: bool,
}

impl Default for InverseSettings {
    fn default() -> Self {
        Self {
            position_tolerance: 1e-6,
            rotation_tolerance: 1e-6,
            iterations: 100,
            restarts: 100,
            seed: 0,
            bounds: None,
            locked: Vec::new(),
            posture: None,
            explain: true,
        }
    }
}
