//! Inverse kinematics: a configuration that moves a point of a link to a goal.
//!
//! Method: damped least squares within bounds (`descent`), from the given configuration and then from random ones. The
//! damping is proportional to the remaining squared error, after T. Sugihara, "Solvability-Unconcerned Inverse
//! Kinematics by the Levenberg-Marquardt Method", IEEE Transactions on Robotics 27 (2011).

mod closed;
mod descent;
mod path;

pub use path::{Goal, InverseSettings};

use self::closed::ClosedDescent;
use self::descent::{Descend, Descent, Found, LEAST_GAIN, toward};
use self::path::Path;
use super::configurations::ConfigurationSpace;
use super::error::ConfigurationError;
use super::forward::ForwardKinematics;
use super::loops::{Loops, NotClosed, Scratch};

/// With a posture, restarts begin these parts of the way from it to a random configuration, in turn: most solutions
/// near it are found from near it.
const PARTS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// With a posture, the search ends after this many restarts in a row that brought no nearer solution.
const IN_VAIN: usize = 12;

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
    /// One value per DOF, rad or m, within bounds; closed, unless loops may be open or none was found that is. DOFs that do
    /// not move the link keep their start values, but for those that loops tie to DOFs that do. Of values a
    /// whole turn apart that are within the bounds, it has the nearest to the posture, or to the start without a
    /// posture; rotation vectors too, which may then be longer than a half turn.
    pub configuration: Vec<f64>,
    /// Distance of the point from the goal, metres.
    pub position_error: f64,
    /// Angle between the link's rotation and the goal, radians; 0 for a goal without rotation.
    pub rotation_error: f64,
    /// Number of descents from random configurations.
    pub restarts: usize,
    /// Number of iterations of all descents.
    pub iterations: usize,
    /// Whether the goal is reached; if not, why.
    pub verdict: Verdict,
}

/// Whether a goal is reached; if not, why.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It is reached within the tolerances.
    Reached,
    /// Every configuration that was found to reach it was refused, such as one in collision.
    Refused,
    /// None within the bounds was found, but one beyond them.
    Limits,
    /// None was found, within the bounds or beyond them: as a rule, the goal is farther than the robot reaches, or
    /// turned in a way that its joints cannot turn. This is a search, not a proof.
    OutOfReach,
    /// None was found that is closed, within the bounds or beyond them, but one within the bounds with open loops.
    Loops,
    /// None within the bounds was found; why was not searched for, as [`InverseSettings::explain`] is false, or the
    /// search was stopped.
    Unknown,
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

/// Conditions of a search, besides its settings.
pub struct Conditions<'a> {
    /// Whether a configuration that reaches the goal counts as a solution, such as one without collision.
    pub accepts: &'a (dyn Fn(&[f64]) -> bool + 'a),
    /// If it returns true, the search ends before the next restart.
    pub stops: &'a (dyn Fn() -> bool + 'a),
    /// What a solution closes; `None` for a tree.
    pub loops: Option<&'a Loops>,
}

impl ForwardKinematics {
    /// Searches for a configuration that reaches a goal: damped least squares from `start`, then from random
    /// configurations.
    ///
    /// Values of `start` out of bounds are first moved into bounds: angles that move the link by whole turns if
    /// possible, others to the nearest bound. DOFs that do not move the link, and locked ones, then keep their value.
    /// The bounds of rotation vectors are ignored, unless lower and upper are equal. A goal for a link that does not
    /// exist is not reached.
    ///
    /// # Errors
    /// If `start` or the posture has the wrong length, or a value that is not finite.
    pub fn reach(
        &self,
        goal: &Goal,
        start: &[f64],
        space: &ConfigurationSpace,
        settings: &InverseSettings,
        conditions: &Conditions,
    ) -> Result<Inverse, ConfigurationError> {
        self.check(start)?;
        if let Some(posture) = &settings.posture {
            self.check(posture)?;
        }
        let near = settings.posture.as_deref().unwrap_or(start);
        let mut bounds = space.bounds().to_vec();
        for dof in &settings.locked {
            if let Some(bounds) = bounds.get_mut(*dof) {
                *bounds = [start[*dof]; 2];
            }
        }
        let loops = conditions.loops;
        let path = Path::new(self, goal, &bounds, loops);
        let mut first = start.to_vec();
        path.confine(&mut first);
        if let Some(loops) = loops {
            // What does not move the link is closed once, and stays.
            let is_held = |dof: usize| path.place[dof].is_some() || settings.locked.contains(&dof);
            let closing = loops.close(self, &mut first, &bounds, is_held, &mut Scratch::default());
            if let Err(NotClosed::Unusable(error)) = closing {
                return Err(error);
            }
        }
        let asked = Asked { kinematics: self, goal, settings, near };
        let mut search = Search {
            path: &path,
            space,
            settings,
            conditions,
            descent: asked.descent(&path, loops),
            restarts: 0,
            refused: None,
        };
        let (best, mut iterations) = (search.best(&first), search.descent.tree().iterations);
        // Whether any is reached within other bounds, from the best, then from random ones.
        let mut reaches = |bounds: &[[f64; 2]], loops: Option<&Loops>| {
            let path = Path::new(self, goal, bounds, loops);
            let mut descent = asked.descent(&path, loops);
            let others = space.with_bounds(bounds).into_iter().flat_map(|space| {
                let seeds = (1..=settings.restarts as u64).map(|k| settings.seed.wrapping_add(k));
                let (path, first) = (&path, &first);
                seeds.map(move |seed| path.restarted(first, &space.sampled(seed)))
            });
            let mut begins = std::iter::once(best.configuration.clone()).chain(others);
            let reaches = begins.any(|begin| !(conditions.stops)() && descent.from(begin).reached);
            iterations += descent.tree().iterations;
            reaches
        };
        let verdict = match (best.reached, search.refused.is_some()) {
            (true, _) => Verdict::Reached,
            (false, true) => Verdict::Refused,
            _ if !settings.explain || (conditions.stops)() => Verdict::Unknown,
            _ => {
                let wide = path.unlimited(&bounds, path.reach() + best.position_error);
                let limits = reaches(&wide, loops);
                let open = !limits && loops.is_some() && reaches(&bounds, None);
                match (limits, open, (conditions.stops)()) {
                    (true, _, _) => Verdict::Limits,
                    (false, true, _) => Verdict::Loops,
                    (false, false, true) => Verdict::Unknown,
                    (false, false, false) => Verdict::OutOfReach,
                }
            }
        };
        let restarts = search.restarts;
        let best = search.refused.filter(|_| !best.reached).unwrap_or(best);
        let solution = InverseSolution {
            configuration: best.configuration,
            position_error: best.position_error,
            rotation_error: best.rotation_error,
            restarts,
            iterations,
            verdict,
        };
        Ok(match verdict {
            Verdict::Reached => Inverse::Reached(solution),
            _ => Inverse::Nearest(solution),
        })
    }
}

/// What all descents to a goal share.
#[derive(Clone, Copy)]
struct Asked<'a> {
    kinematics: &'a ForwardKinematics,
    goal: &'a Goal,
    settings: &'a InverseSettings,
    near: &'a [f64],
}

impl<'a> Asked<'a> {
    /// A descent among all configurations, or among those in which loops are closed.
    fn descent<'b>(self, path: &'b Path<'b>, loops: Option<&'b Loops>) -> Box<dyn Descend<'b> + 'b>
    where
        'a: 'b,
    {
        let tree = Descent::new(path, self.goal, self.settings, self.near);
        match loops {
            None => Box::new(tree),
            Some(loops) => Box::new(ClosedDescent::new(self.kinematics, loops, path, tree)),
        }
    }
}

/// A search within bounds.
struct Search<'a> {
    path: &'a Path<'a>,
    space: &'a ConfigurationSpace,
    settings: &'a InverseSettings,
    conditions: &'a Conditions<'a>,
    descent: Box<dyn Descend<'a> + 'a>,
    restarts: usize,
    /// The first configuration that reaches the goal and was refused.
    refused: Option<Found>,
}

impl Search<'_> {
    /// The best configuration; the nearest one, if none reaches the goal and is accepted.
    fn best(&mut self, first: &[f64]) -> Found {
        let mut best = self.from(first.to_vec(), None);
        let most = if self.path.dofs.is_empty() { 0 } else { self.settings.restarts };
        let posture = self.settings.posture.as_deref();
        if let Some(posture) = posture {
            let found = self.from(self.path.restarted(first, posture), Some(&best));
            if self.is_better(&found, &best) {
                best = found;
            }
        }
        let mut in_vain = 0;
        while !(best.reached && (posture.is_none() || in_vain >= IN_VAIN))
            && self.restarts < most
            && !(self.conditions.stops)()
        {
            self.restarts += 1;
            let seed = self.settings.seed.wrapping_add(self.restarts as u64);
            let mut other = self.space.sampled(seed);
            for (value, near) in other.iter_mut().zip(posture.into_iter().flatten()) {
                *value = near + PARTS[self.restarts % PARTS.len()] * (*value - near);
            }
            let found = self.from(self.path.restarted(first, &other), Some(&best));
            in_vain += usize::from(best.reached);
            if self.is_better(&found, &best) {
                best = found;
                in_vain = 0;
            }
        }
        best
    }

    fn is_better(&self, found: &Found, best: &Found) -> bool {
        match (found.reached, best.reached, &self.settings.posture) {
            (true, true, Some(posture)) => {
                let [found, best] = [found, best].map(|one| &one.configuration);
                let [found, best] = [found, best].map(|one| self.path.distance(one, posture));
                found < best * (1.0 - LEAST_GAIN)
            }
            (true, _, _) => true,
            (false, reached, _) => !reached && found.cost < best.cost,
        }
    }

    /// A descent whose result is reached only if it is accepted. What will not be nearer to the posture than the best so far is
    /// not moved as far toward it as it goes.
    fn from(&mut self, begin: Vec<f64>, best: Option<&Found>) -> Found {
        let mut found = self.descent.from(begin);
        if !found.reached {
            return found;
        }
        if let Some(posture) = &self.settings.posture {
            let known = best.filter(|best| best.reached).map(|best| &*best.configuration);
            let nearer = toward(&mut *self.descent, self.path, posture, found.clone(), known);
            // What is nearest may be refused, and what it began with not.
            if (self.conditions.accepts)(&nearer.configuration) {
                return nearer;
            }
        }
        if !(self.conditions.accepts)(&found.configuration) {
            self.refused.get_or_insert_with(|| found.clone());
            found.reached = false;
            // Worse than any that is only near.
            found.cost = f64::INFINITY;
        }
        found
    }
}
