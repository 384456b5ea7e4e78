//! Inverse kinematics: a configuration that moves a point of a link to a goal.
//!
//! Method: damped least squares within bounds (`descent`), from the given configuration and then from random ones. The
//! damping is proportional to the remaining squared error, after T. Sugihara, "Solvability-Unconcerned Inverse
//! Kinematics by the Levenberg-Marquardt Method", IEEE Transactions on Robotics 27 (2011).

mod descent;
mod goal;
mod path;

pub use goal::{Goal, InverseSettings};

use self::descent::Descent;
use self::path::Path;
use super::configurations::ConfigurationSpace;
use super::error::ConfigurationError;
use super::forward::ForwardKinematics;

/// The result of [`ForwardKinematics::reach`].
#[derive(Debug, Clone, PartialEq)]
pub enum Inverse {
    /// The goal is reached within the tolerances.
    Reached(InverseSolution),
    /// The goal was not reached, because it is unreachable or the search gave up: the nearest solution.
    Nearest(InverseSolution),
}

/// A configuration and its errors.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseSolution {
    /// One value per DOF, rad or m, within bounds. DOFs that do not move the link keep their start values.
    pub configuration: Vec<f64>,
    /// Distance of the point from the goal, metres.
    pub position_error: f64,
    /// Angle between the link's rotation and the goal, radians; 0 for a goal without rotation.
    pub rotation_error: f64,
    /// Number of descents from random configurations.
    pub restarts: usize,
    /// Number of iterations of all descents.
    pub iterations: usize,
}

impl Inverse {
    /// Whether the goal is reached.
    pub fn is_reached(&self) -> bool {
        matches!(self, Inverse::Reached(_))
    }

    /// The solution, if the goal is reached.
    pub fn reached(self) -> Option<InverseSolution> {
        match self {
            Inverse::Reached(solution) => Some(solution),
            Inverse::Nearest(_) => None,
        }
    }

    /// The nearest solution, reached or not.
    pub fn nearest(&self) -> &InverseSolution {
        match self {
            Inverse::Reached(solution) | Inverse::Nearest(solution) => solution,
        }
    }
}

impl ForwardKinematics {
    /// Searches for a configuration that reaches a goal: damped least squares from `start`, then from random
    /// configurations.
    ///
    /// Values of `start` out of bounds are first moved into bounds: angles that move the link by whole turns if
    /// possible, others to the nearest bound. DOFs that do not move the link then keep their value. The bounds of
    /// rotation vectors are ignored. A goal for a link that does not exist is not reached. If `stop` returns true, the
    /// search ends before the next restart.
    ///
    /// # Errors
    /// If `start` has the wrong length, or a value that is not finite.
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
