//! Inverse kinematics: a configuration in which a point of a link is where it is wanted.
//!
//! Method: damped least squares within bounds, `descent`, from the given configuration and then from others. The
//! damping is in proportion to what is left of the error, after T. Sugihara, "Solvability-Unconcerned Inverse Kinematics
//! by the Levenberg-Marquardt Method", IEEE Transactions on Robotics 27 (2011).

mod descent;
mod path;

use nalgebra::{Point3, UnitQuaternion};

use self::descent::Descent;
use self::path::Path;
use super::configurations::ConfigurationSpace;
use super::error::ConfigurationError;
use super::forward::ForwardKinematics;

/// Where a point of a link should be, and how the link should be turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal {
    /// The link.
    pub link: usize,
    /// The point, in the link's frame, metres.
    pub point: Point3<f64>,
    /// Where it should be, in the root link's frame, metres.
    pub position: Point3<f64>,
    /// How the link's frame should be turned in the root link's; `None` where that does not matter.
    pub rotation: Option<UnitQuaternion<f64>>,
}

/// When [`ForwardKinematics::reach`] has found its target, and when it gives up.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseSettings {
    /// Metres that the point may be off; 1e-6 unless you say otherwise.
    pub position_tolerance: f64,
    /// Radians that the link may be turned; 1e-6 unless you say otherwise.
    pub rotation_tolerance: f64,
    /// Steps of each descent, at most; 100 unless you say otherwise.
    pub iterations: usize,
    /// Descents from random configurations after that from the start, at most; 100 unless you say otherwise.
    pub restarts: usize,
    /// Restart 1, 2, ... begins at [`ConfigurationSpace::sampled`] of this number and the
    /// restart's. So the same question has the same answer.
    pub seed: u64,
    /// The bounds of each DOF, in place of those of `bounds_module`: for a base without limits, which otherwise stays
    /// within 1 m, or for a part of what the robot can do.
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

/// What [`ForwardKinematics::reach`] found.
#[derive(Debug, Clone, PartialEq)]
pub enum Inverse {
    /// The target is reached.
    Reached(InverseSolution),
    /// The target was not reached, because it cannot be or because the search gave up: this came nearest.
    Nearest(InverseSolution),
}

/// A configuration, and how near to its target it is.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseSolution {
    /// One value for each DOF, rad or m, within bounds. DOFs that do not move the link are as they were at the start.
    pub configuration: Vec<f64>,
    /// How far the point is from its target, metres.
    pub position_error: f64,
    /// The angle by which the link is turned against its target, radians; 0 where only a place is asked for.
    pub rotation_error: f64,
    /// Descents from random configurations that it took.
    pub restarts: usize,
    /// Steps of all descents.
    pub iterations: usize,
}

impl Inverse {
    /// Whether the target is reached.
    pub fn is_reached(&self) -> bool {
        matches!(self, Inverse::Reached(_))
    }

    /// The solution where the target is reached.
    pub fn reached(self) -> Option<InverseSolution> {
        match self {
            Inverse::Reached(solution) => Some(solution),
            Inverse::Nearest(_) => None,
        }
    }

    /// What came nearest, reached or not.
    pub fn nearest(&self) -> &InverseSolution {
        match self {
            Inverse::Reached(solution) | Inverse::Nearest(solution) => solution,
        }
    }
}

impl ForwardKinematics {
    /// Looks for a configuration in which a goal is reached: by damped least squares from `start`, then from random
    /// configurations.
    ///
    /// What of `start` is out of bounds is moved to the nearest bound. DOFs that do not move the link stay as they are
    /// there; the bounds of rotation vectors are not looked at. A goal for a link that is not there is not reached. When
    /// `stop` says so, the search gives up before the next restart.
    ///
    /// # Errors
    /// Where `start` has another length, or a value that is not finite.
    pub fn reach(
        &self,
        goal: &Goal,
        start: &[f64],
        space: &ConfigurationSpace,
        settings: &InverseSettings,
        stop: &dyn Fn() -> bool,
    ) -> Result<Inverse, ConfigurationError> {
        self.check(start)?;
        let path = Path::new(self, goal, space.bounds());
        let mut descent = Descent::new(&path, goal, settings);
        let mut first = start.to_vec();
        path.confine(&mut first);
        let mut best = descent.from(first.clone());
        let mut restarts = 0;
        let most = if path.dofs.is_empty() {
            0
        } else {
            settings.restarts
        };
        while !best.reached && restarts < most && !stop() {
            restarts += 1;
            let mut begin = first.clone();
            let other = space.sampled(settings.seed.wrapping_add(restarts as u64));
            for &dof in &path.dofs {
                begin[dof] = other[dof];
            }
            path.confine(&mut begin);
            let found = descent.from(begin);
            if found.reached || found.cost < best.cost {
                best = found;
            }
        }
        let solution = InverseSolution {
            configuration: best.configuration,
            position_error: best.position_error,
            rotation_error: best.rotation_error,
            restarts,
            iterations: descent.iterations,
        };
        Ok(match best.reached {
            true => Inverse::Reached(solution),
            false => Inverse::Nearest(solution),
        })
    }
}
