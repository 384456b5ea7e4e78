//! Damped least squares from one start configuration.

use nalgebra::{Matrix6, Vector3, Vector6};

use super::path::{Goal, InverseSettings, Path, RangeKind};
use crate::jacobian::Place;
use crate::rotation::to_rotation_vector;

/// Maximum change of a DOF per iteration, rad or m. The linearisation is poor beyond it.
pub(super) const STEP: f64 = 0.8;

/// A descent is stuck when this many consecutive steps each reduced the cost by less than the fraction [`LITTLE`].
const PATIENCE: usize = 3;
const LITTLE: f64 = 1e-2;

/// Damping relative to the cost: initial and minimum value.
const DAMPING: [f64; 2] = [0.1, 1e-3];

/// Consecutive rejected steps before a descent gives up.
const REFUSED: usize = 8;

/// A solution is as near to a posture as it gets when this part of the way there does not bring it nearer by this
/// fraction.
const SMALLEST_PART: f64 = 0.01;
pub(super) const LEAST_GAIN: f64 = 1e-6;

/// The parts of the way to a posture that is free which are tried.
const LEAST_PART: f64 = 0.1;
const MOST_PART: f64 = 4.0;

/// A solution nears where it will end when the way to the posture that is free is this part of that before.
const ENDING: f64 = 0.7;

/// A solution whose free way is at most this long, rad or m, ends at a known one that is as near.
const NEAR: f64 = 0.1;

#[derive(Clone)]
pub(super) struct Found {
    pub configuration: Vec<f64>,
    pub cost: f64,
    pub position_error: f64,
    pub rotation_error: f64,
    pub reached: bool,
}

pub(super) trait Descend<'a> {
    /// The goal, the error and the Jacobian.
    fn tree(&mut self) -> &mut Descent<'a>;
    /// Moves a configuration to where the descent may be, such as a closed one. False if there is none near.
    fn settle(&mut self, q: &mut [f64]) -> bool;
    /// Linearises at a configuration whose error is known.
    fn linearise(&mut self, q: &[f64]);
    /// One step of damped least squares within bounds. A DOF that would leave its bounds is set to the bound, and the
    /// others are solved again to compensate.
    fn step(&mut self, q: &[f64], left: &Vector6<f64>, damping: f64, next: &mut [f64]);
    /// The part of the way to a posture that is free at a solution, for each DOF of the path; `None` if there is none that
    /// can be computed.
    fn freed(&mut self, q: &[f64], posture: &[f64]) -> Option<Vec<f64>>;

    /// Descends from a configuration within bounds.
    fn from(&mut self, start: Vec<f64>) -> Found {
        let mut q = start;
        let is_settled = self.settle(&mut q);
        let mut left = self.tree().left(&q);
        if !is_settled {
            let found = self.tree().found(q, &left);
            return Found { reached: false, cost: f64::INFINITY, ..found };
        }
        let mut next = q.clone();
        let [mut damping, least_damping] = DAMPING;
        let (mut slow, mut refused) = (0, 0);
        let mut fresh = false;
        for _ in 0..self.tree().settings.iterations {
            if self.tree().is_reached(&left) || slow >= PATIENCE || refused >= REFUSED {
                break;
            }
            self.tree().iterations += 1;
            if !fresh {
                self.linearise(&q);
                fresh = true;
            }
            self.step(&q, &left.vector, damping * left.cost, &mut next);
            let after = self.settle(&mut next).then(|| self.tree().left(&next));
            let is_worse = |after: &Left| after.cost.is_nan() || after.cost >= left.cost;
            let Some(after) = after.filter(|after| !is_worse(after)) else {
                damping = (damping * 10.0).max(1e-2);
                refused += 1;
                continue;
            };
            slow = if after.cost > (1.0 - LITTLE) * left.cost { slow + 1 } else { 0 };
            refused = 0;
            damping = (damping * 0.3).max(least_damping);
            fresh = false;
            left = after;
            q.copy_from_slice(&next);
        }
        self.tree().found(q, &left)
    }
}

/// Moves a solution toward a posture, along the motions that the goal leaves free. It ends before where it will not be nearer
/// than another solution that is `known`: near that one, or where the rest of the way is too short.
///
/// The part of the way is that of J. Barzilai and J. Borwein, "Two-Point Step Size Gradient Methods", IMA Journal of Numerical
/// Analysis 8 (1988): where one motion is free, the secant method.
pub(super) fn toward(
    descent: &mut dyn Descend<'_>,
    path: &Path,
    posture: &[f64],
    mut found: Found,
    known: Option<&[f64]>,
) -> Found {
    let away = |q: &[f64]| path.distance(q, posture);
    let mut part = 1.0;
    let mut last: Option<(Vec<f64>, Vec<f64>)> = None;
    while part > SMALLEST_PART {
        let q = &found.configuration;
        let Some(free) = descent.freed(q, posture) else { return found };
        let (before, left) = (away(q), norm(&free));
        if left * left <= LEAST_GAIN * before * before {
            return found;
        }
        if let Some((from, other)) = &last {
            let moved: Vec<f64> = path.dofs.iter().map(|dof| q[*dof] - from[*dof]).collect();
            let less: f64 =
                moved.iter().zip(other.iter().zip(&free)).map(|(s, (a, b))| s * (a - b)).sum();
            if less > 0.0 {
                part = (norm(&moved).powi(2) / less).clamp(LEAST_PART, MOST_PART);
            }
            let is_ending = left <= ENDING * norm(other);
            if let Some(known) = known
                && is_ending
                && (before * before - (2.0 * left).powi(2) > away(known).powi(2)
                    || (left <= NEAR && path.distance(q, known) <= 2.0 * left + LEAST_GAIN.sqrt()))
            {
                return found;
            }
        }
        let next = loop {
            let mut next = q.clone();
            for (dof, change) in path.dofs.iter().zip(&free) {
                next[*dof] += part * change;
            }
            path.confine(&mut next);
            let next = descent.from(next);
            if next.reached && away(&next.configuration) < before * (1.0 - LEAST_GAIN) {
                break next;
            }
            part *= 0.5;
            if part <= SMALLEST_PART {
                return found;
            }
        };
        last = Some((found.configuration, free));
        found = next;
    }
    found
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// State shared by all descents to a goal.
pub(super) struct Descent<'a> {
    path: &'a Path<'a>,
    goal: &'a Goal,
    pub settings: &'a InverseSettings,
    /// The configuration that decides between values whole turns apart.
    near: &'a [f64],
    /// The length, in metres, that weighs as much as a radian.
    pub length: f64,
    pub iterations: usize,
    place: Place,
    pub jacobian: Vec<Vector6<f64>>,
    /// Which columns a step may still change.
    free: Vec<bool>,
}

/// The remaining error: metres, then radians times the length.
pub(super) struct Left {
    pub vector: Vector6<f64>,
    pub cost: f64,
    position: f64,
    rotation: f64,
}

impl<'a> Descent<'a> {
    pub fn new(
        path: &'a Path<'a>,
        goal: &'a Goal,
        settings: &'a InverseSettings,
        near: &'a [f64],
    ) -> Self {
        let reach = path.reach();
        Self {
            path,
            goal,
            settings,
            near,
            length: if reach > 1e-6 { 0.3 * reach } else { 1.0 },
            iterations: 0,
            place: Place::default(),
            jacobian: Vec::new(),
            free: Vec::new(),
        }
    }

    /// What a descent ends with.
    pub fn found(&self, mut configuration: Vec<f64>, left: &Left) -> Found {
        self.path.settle(&mut configuration, self.near);
        Found {
            reached: self.is_reached(left),
            configuration,
            cost: left.cost,
            position_error: left.position,
            rotation_error: left.rotation,
        }
    }

    pub fn is_reached(&self, left: &Left) -> bool {
        left.position <= self.settings.position_tolerance
            && left.rotation <= self.settings.rotation_tolerance
    }

    /// Computes the Jacobian of the error, in the units of its vector, at a configuration whose error is known.
    pub fn linearise(&mut self, q: &[f64]) {
        self.path.jacobian(q, &self.place, &mut self.jacobian);
        let linear = f64::from(u8::from(self.goal.position.is_some()));
        let angular = if self.goal.rotation.is_some() { self.length } else { 0.0 };
        for column in &mut self.jacobian {
            for row in 0..6 {
                column[row] *= if row < 3 { linear } else { angular };
            }
            *column = self.goal.weighted(column);
        }
    }

    pub fn left(&mut self, q: &[f64]) -> Left {
        let point = self.path.place(q, &mut self.place);
        let shift = self.goal.position.map_or(Vector3::zeros(), |position| position - point);
        let turn = self.goal.rotation.map_or(Vector3::zeros(), |rotation| {
            to_rotation_vector(&(rotation * self.place.pose.rotation.inverse())).into()
        });
        let scaled = turn * self.length;
        let vector = Vector6::new(shift.x, shift.y, shift.z, scaled.x, scaled.y, scaled.z);
        let vector = self.goal.weighted(&vector);
        let (position, rotation) = match self.goal.weights {
            None => (shift.norm(), turn.norm()),
            Some(_) => {
                let part = |first: usize| vector.fixed_rows::<3>(first).norm();
                (part(0), part(3) / self.length)
            }
        };
        Left { vector, cost: vector.norm_squared(), position, rotation }
    }
}

impl<'a> Descend<'a> for Descent<'a> {
    fn tree(&mut self) -> &mut Descent<'a> {
        self
    }

    fn settle(&mut self, _: &mut [f64]) -> bool {
        true
    }

    fn linearise(&mut self, q: &[f64]) {
        Descent::linearise(self, q);
    }

    fn step(&mut self, q: &[f64], left: &Vector6<f64>, damping: f64, next: &mut [f64]) {
        let Self { path, jacobian: columns, free, .. } = self;
        let mut left = *left;
        free.clear();
        free.resize(columns.len(), true);
        next.copy_from_slice(q);
        let floor =
            1e-12 * columns.iter().map(|c| c.norm_squared()).sum::<f64>() + f64::MIN_POSITIVE;
        for _ in 0..=columns.len() {
            let mut matrix = Matrix6::from_diagonal_element(damping + floor);
            for (column, _) in columns.iter().zip(&*free).filter(|(_, free)| **free) {
                matrix.ger(1.0, column, column, 1.0);
            }
            let Some(factor) = matrix.cholesky() else { return };
            let weights = factor.solve(&left);
            let largest = columns
                .iter()
                .zip(&*free)
                .filter(|(_, free)| **free)
                .map(|(column, _)| column.dot(&weights).abs())
                .fold(0.0, f64::max);
            let shorter = if largest > STEP { STEP / largest } else { 1.0 };
            let mut stopped = false;
            for (k, column) in columns.iter().enumerate() {
                if !free[k] {
                    continue;
                }
                let dof = path.dofs[k];
                let (moved, is_stopped) = path.moved(k, q[dof] + shorter * column.dot(&weights));
                next[dof] = moved;
                if is_stopped {
                    free[k] = false;
                    stopped = true;
                    left -= column * (next[dof] - q[dof]);
                }
            }
            if !stopped {
                break;
            }
        }
        path.wrap(next);
    }

    fn freed(&mut self, q: &[f64], posture: &[f64]) -> Option<Vec<f64>> {
        self.left(q);
        self.linearise(q);
        let Self { path, jacobian, free: moves, .. } = self;
        moves.clear();
        moves.resize(jacobian.len(), true);
        let mut wanted: Vec<f64> = path.dofs.iter().map(|dof| posture[*dof] - q[*dof]).collect();
        // The DOF that would leave its bounds by most goes to the bound, and the others are asked again: without it, what
        // made up for it may stay within.
        loop {
            let free = way(jacobian, moves, &wanted)?;
            let mut farthest = None;
            let mut most = 0.0;
            for (k, change) in free.iter().enumerate() {
                let [lower, upper] = path.bounds(k).map(|bound| bound - q[path.dofs[k]]);
                let room = change.max(lower).min(upper);
                let beyond = (change - room).abs();
                if moves[k] && path.kinds[k] == RangeKind::Bounded && beyond > most {
                    (farthest, most) = (Some((k, room)), beyond);
                }
            }
            let Some((k, room)) = farthest else { return Some(free) };
            (moves[k], wanted[k]) = (false, room);
        }
    }
}

/// The part of the wanted changes that keeps the goal: of DOFs that do not move by it, all; the others make up for them.
fn way(jacobian: &[Vector6<f64>], moves: &[bool], wanted: &[f64]) -> Option<Vec<f64>> {
    let mut free = wanted.to_vec();
    let trace: f64 = jacobian.iter().map(|column| column.norm_squared()).sum();
    // So small that what the goal needs is kept, and so large that directions which it leaves free, and singular ones,
    // have no part in it.
    let mut matrix = Matrix6::from_diagonal_element(1e-10 * trace + f64::MIN_POSITIVE);
    let mut moved = Vector6::zeros();
    for ((column, moves), change) in jacobian.iter().zip(moves).zip(wanted) {
        if *moves {
            matrix.ger(1.0, column, column, 1.0);
        }
        moved += column * *change;
    }
    let needed = matrix.cholesky()?.solve(&moved);
    for ((change, column), _) in
        free.iter_mut().zip(jacobian).zip(moves).filter(|(_, moves)| **moves)
    {
        *change -= column.dot(&needed);
    }
    Some(free)
}
