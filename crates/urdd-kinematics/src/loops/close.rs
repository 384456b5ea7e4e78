//! The closed configuration nearest to a given one, by the method of Levenberg and Marquardt within the bounds.

use nalgebra::Isometry3;

use crate::error::ConfigurationError;
use crate::forward::ForwardKinematics;
use crate::loops::equations::CLOSED;
use crate::loops::model::{Group, Loops};

/// Most steps from one configuration.
const MOST_STEPS: usize = 200;
/// The damping at the beginning, as a fraction of the mean of the diagonal.
const DAMPING: f64 = 1e-3;
/// The least damping, which keeps redundant equations solvable.
const LEAST_DAMPING: f64 = 1e-13;
/// The largest damping; a step that it makes is no progress.
const MOST_DAMPING: f64 = 1e8;
/// The farthest that a DOF moves in one step, rad or reaches.
const LONGEST: f64 = 0.5;
/// Further steps are worthless below this sum of squares.
const DONE: f64 = 1e-30;

/// Memory of [`Loops::close`]; reusable, so that further calls allocate nothing.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    poses: Vec<Isometry3<f64>>,
    residual: Vec<f64>,
    jacobian: Vec<f64>,
    normal: Vec<f64>,
    factor: Vec<f64>,
    gradient: Vec<f64>,
    step: Vec<f64>,
    trial: Vec<f64>,
    /// Places in the group's DOFs.
    free: Vec<usize>,
    spent: u64,
    most: Option<u64>,
}

impl Scratch {
    /// One with which closings end with [`NotClosed::Apart`] once all of them together have taken this much work, in the unit
    /// of [`Loops::work`].
    pub fn within(most: u64) -> Self {
        Scratch { most: Some(most), ..Scratch::default() }
    }

    /// Counts work done elsewhere.
    pub fn spend(&mut self, work: u64) {
        self.spent = self.spent.saturating_add(work);
    }

    /// Whether the work is spent.
    pub fn is_spent(&self) -> bool {
        self.most.is_some_and(|most| self.spent > most)
    }

    /// The link poses of the configuration that was found last.
    pub fn poses(&self) -> &[Isometry3<f64>] {
        &self.poses
    }
}

/// No closed configuration was found from there.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum NotClosed {
    /// What was found is as near to closed as it gets from there; the configuration is left in place.
    Apart,
    /// The configuration cannot be used.
    Unusable(ConfigurationError),
}

impl From<ConfigurationError> for NotClosed {
    fn from(error: ConfigurationError) -> Self {
        NotClosed::Unusable(error)
    }
}

impl Loops {
    /// Moves a configuration to a closed one that is near, within the bounds. DOFs that are `held`, and those that no loop
    /// depends on, stay. `bounds` has one pair for each DOF, infinite where there is none. Returns the number of steps.
    ///
    /// # Errors
    /// [`NotClosed::Apart`] where none is found; the configuration is then the one with the smallest gaps.
    pub fn close(
        &self,
        kinematics: &ForwardKinematics,
        configuration: &mut [f64],
        bounds: &[[f64; 2]],
        held: impl Fn(usize) -> bool,
        scratch: &mut Scratch,
    ) -> Result<usize, NotClosed> {
        let at = scratch;
        kinematics.check(configuration)?;
        let mut steps = 0;
        for group in &self.groups {
            steps += self.close_group(group, kinematics, configuration, bounds, &held, at)?;
        }
        kinematics.link_poses_into(configuration, &mut at.poses)?;
        match self.is_closed(configuration, &at.poses) {
            true => Ok(steps),
            false => Err(NotClosed::Apart),
        }
    }

    fn close_group(
        &self,
        group: &Group,
        kinematics: &ForwardKinematics,
        configuration: &mut [f64],
        bounds: &[[f64; 2]],
        held: &impl Fn(usize) -> bool,
        at: &mut Scratch,
    ) -> Result<usize, NotClosed> {
        let rows = group.num_rows();
        for dof in group.dofs.iter().filter(|dof| !held(**dof)) {
            configuration[*dof] = within(configuration[*dof], bounds[*dof]);
        }
        kinematics.link_poses_into(configuration, &mut at.poses)?;
        at.residual.resize(rows, 0.0);
        at.jacobian.resize(rows * group.dofs.len(), 0.0);
        self.residual_into(group, configuration, &at.poses, &mut at.residual);
        let mut cost = squares(&at.residual);
        let mut damping = DAMPING;
        let mut steps = 0;
        let mut is_new = true;
        let of_step = self.work_of(group, kinematics) as u64;
        while steps < MOST_STEPS && cost > DONE && damping < MOST_DAMPING && !at.is_spent() {
            steps += 1;
            at.spend(of_step);
            if is_new {
                let Scratch { poses, jacobian, .. } = at;
                self.jacobian_into(group, kinematics, configuration, poses, jacobian);
                gather(group, configuration, bounds, held, at);
                is_new = false;
            }
            if at.free.is_empty() {
                break;
            }
            if !solve(at, damping) {
                damping = (damping * 10.0).max(LEAST_DAMPING);
                continue;
            }
            at.trial.clear();
            at.trial.extend_from_slice(configuration);
            let longest = at.step.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let factor = if longest > LONGEST { LONGEST / longest } else { 1.0 };
            for (place, step) in at.free.iter().zip(&at.step) {
                let dof = group.dofs[*place];
                let moved = at.trial[dof] + step * factor * self.units[dof];
                at.trial[dof] = within(moved, bounds[dof]);
            }
            kinematics.link_poses_into(&at.trial, &mut at.poses)?;
            self.residual_into(group, &at.trial, &at.poses, &mut at.residual);
            let next = squares(&at.residual);
            if next < cost {
                let gain = next / cost;
                cost = next;
                configuration.copy_from_slice(&at.trial);
                damping = (damping * if gain < 0.25 { 0.02 } else { 0.3 }).max(LEAST_DAMPING);
                is_new = true;
                // Rounding alone moves it from here on.
                if cost < CLOSED * CLOSED * 1e-6 && gain > 0.5 {
                    break;
                }
            } else {
                damping *= 8.0;
                if longest < 1e-15 {
                    break;
                }
            }
        }
        Ok(steps)
    }
}

/// The normal equations of the DOFs of a group that may move.
fn gather(
    group: &Group,
    configuration: &[f64],
    bounds: &[[f64; 2]],
    held: &impl Fn(usize) -> bool,
    at: &mut Scratch,
) {
    let rows = group.num_rows();
    at.free.clear();
    at.gradient.clear();
    for (place, dof) in group.dofs.iter().enumerate().filter(|(_, dof)| !held(**dof)) {
        let column = &at.jacobian[place * rows..(place + 1) * rows];
        let slope: f64 = column.iter().zip(&at.residual).map(|(a, b)| a * b).sum();
        let [a, b] = bounds[*dof];
        let q = configuration[*dof];
        // At a bound that it would leave, a DOF stays.
        if (q <= a.min(b) && slope > 0.0) || (q >= a.max(b) && slope < 0.0) {
            continue;
        }
        at.free.push(place);
        at.gradient.push(slope);
    }
    let n = at.free.len();
    at.normal.clear();
    at.normal.resize(n * n, 0.0);
    for i in 0..n {
        for j in 0..=i {
            let [a, b] = [at.free[i], at.free[j]]
                .map(|place| &at.jacobian[place * rows..(place + 1) * rows]);
            at.normal[i * n + j] = a.iter().zip(b).map(|(a, b)| a * b).sum();
        }
    }
}

/// Solves the damped normal equations for the step. False where they are not positive definite.
fn solve(at: &mut Scratch, damping: f64) -> bool {
    let n = at.free.len();
    at.step.clear();
    let trace: f64 = (0..n).map(|i| at.normal[i * n + i]).sum();
    let added = damping * trace / n as f64;
    at.factor.clear();
    at.factor.extend_from_slice(&at.normal);
    at.step.extend(at.gradient.iter().map(|slope| -slope));
    solve_cholesky(&mut at.factor, added, &mut at.step)
}

fn within(q: f64, [a, b]: [f64; 2]) -> f64 {
    q.max(a.min(b)).min(a.max(b))
}

fn squares(rows: &[f64]) -> f64 {
    rows.iter().map(|x| x * x).sum()
}

/// Solves a system of equations with a symmetric, positive definite matrix in place: `right` becomes the solution, and the lower triangle of `matrix`, row by row, its factor.
/// `added` is added to the diagonal first. False where the matrix is not positive definite; both are then any.
pub(crate) fn solve_cholesky(matrix: &mut [f64], added: f64, right: &mut [f64]) -> bool {
    let n = right.len();
    for i in 0..n {
        for j in 0..=i {
            let (head, row) = matrix.split_at(i * n);
            let of_j = if i == j { &row[..j] } else { &head[j * n..j * n + j] };
            let dot: f64 = row[..j].iter().zip(of_j).map(|(a, b)| a * b).sum();
            let value = row[j] - dot;
            if i == j {
                let value = value + added;
                if value.is_nan() || value <= 0.0 {
                    return false;
                }
                matrix[i * n + i] = value.sqrt();
            } else {
                matrix[i * n + j] = value / matrix[j * n + j];
            }
        }
    }
    for i in 0..n {
        let dot: f64 = (0..i).map(|j| matrix[i * n + j] * right[j]).sum();
        right[i] = (right[i] - dot) / matrix[i * n + i];
    }
    for i in (0..n).rev() {
        let dot: f64 = (i + 1..n).map(|j| matrix[j * n + i] * right[j]).sum();
        right[i] = (right[i] - dot) / matrix[i * n + i];
    }
    true
}
