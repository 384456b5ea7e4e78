//! What is searched for, and how exactly.

use nalgebra::{Point3, UnitQuaternion};

/// The desired position of a point of a link, and optionally the desired rotation of the link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal {
    /// Index of the link.
    pub link: usize,
    /// The point, in the link's frame, metres.
    pub point: Point3<f64>,
    /// The desired position, in the root link's frame, metres.
    pub position: Point3<f64>,
    /// The desired rotation of the link's frame in the root link's frame; `None` for any.
    pub rotation: Option<UnitQuaternion<f64>>,
}

/// Tolerances and limits of [`ForwardKinematics::reach`](crate::ForwardKinematics::reach).
#[derive(Debug, Clone, PartialEq)]
pub struct InverseSettings {
    /// Position tolerance, metres; default 1e-6.
    pub position_tolerance: f64,
    /// Rotation tolerance, radians; default 1e-6.
    pub rotation_tolerance: f64,
    /// Maximum number of iterations per descent; default 100.
    pub iterations: usize,
    /// Maximum number of descents from random configurations after the first one; default 100.
    pub restarts: usize,
    /// Restart 1, 2, ... uses [`ConfigurationSpace::sampled`](crate::ConfigurationSpace::sampled) with the sum of `seed` and the restart's number. So the
    /// search is deterministic.
    pub seed: u64,
    /// Bounds of each DOF, in place of those of `bounds_module`: for an unlimited base, which otherwise stays within
    /// one metre, or to restrict the robot further.
    pub bounds: Option<Vec<[f64; 2]>>,
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
        }
    }
}
