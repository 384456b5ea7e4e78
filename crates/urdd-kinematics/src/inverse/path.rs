//! What is searched for and how exactly, and the joints and DOFs that move one link.

use std::f64::consts::{PI, TAU};

use nalgebra::{Point3, UnitQuaternion, Vector3, Vector6};

use crate::forward::{ForwardKinematics, Step};
use crate::jacobian::{Branch, Place, add_to, columns};
use crate::joint::Motion;
use crate::loops::Loops;

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
        let Some(weights) = &self.weights else { return *vector };
        let axes = self.rotation.unwrap_or_else(UnitQuaternion::identity);
        let part =
            |first: usize| axes.inverse_transform_vector(&vector.fixed_rows::<3>(first).into());
        let parts = [part(0), part(3)];
        Vector6::from_fn(|row, _| weights[row] * parts[row / 3][row % 3])
    }
}

/// Tolerances and limits of [`ForwardKinematics::reach`].
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
    /// between the posture and anywhere, until 12 restarts in a row bring no nearer solution. Each that may be nearest is moved
    /// toward the posture as far as the goal allows, and the nearest one counts, by the Euclidean distance of the DOFs
    /// that move the link. This is a search: a nearer solution can be missed.
    pub posture: Option<Vec<f64>>,
    /// Whether to find out why a goal is not reached, which takes as long as the search; default true.
    pub explain: bool,
    /// Whether the kinematic loops of the robot may be open in the solution: the search is then that of its spanning tree.
    /// Default false; without meaning for a tree.
    pub open_loops: bool,
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
            open_loops: false,
        }
    }
}

/// The joints from the root to a link, and the DOFs that move it.
pub(super) struct Path<'a> {
    branch: Branch<'a>,
    /// A point of the link, in its frame.
    point: Point3<f64>,
    /// The DOFs that move the link, or follow what does, and are not fixed by their bounds, ascending.
    pub dofs: Vec<usize>,
    /// For each DOF of the robot, its index in `dofs`.
    pub place: Vec<Option<usize>>,
    /// The bounds of all DOFs, lower bound first.
    bounds: Vec<[f64; 2]>,
    /// The range of values of each of `dofs`.
    pub kinds: Vec<RangeKind>,
    vectors: Vec<[usize; 3]>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RangeKind {
    /// Within the bounds.
    Bounded,
    /// Within the bounds; whole turns are equivalent.
    Turning,
    /// Unbounded: a component of a rotation vector.
    Free,
}

impl<'a> Path<'a> {
    pub fn new(
        kinematics: &'a ForwardKinematics,
        goal: &Goal,
        bounds: &[[f64; 2]],
        loops: Option<&Loops>,
    ) -> Self {
        use RangeKind::{Bounded, Free, Turning};
        let branch = kinematics.branch(goal.link);
        // With the link move all DOFs that loops tie to those that move it.
        let moving = |step: &Step, with: &[usize]| {
            step.motion.dofs().iter().any(|dof| with.binary_search(dof).is_ok())
        };
        let moves_link = |with: &[usize]| branch.steps.iter().any(|step| moving(step, with));
        let groups = loops.into_iter().flat_map(Loops::groups);
        let groups: Vec<&[usize]> = groups.filter(|group| moves_link(group)).collect();
        let tied = kinematics.steps.iter().filter(|step| {
            let is_tied = groups.iter().any(|group| moving(step, group));
            is_tied && !branch.steps.iter().any(|other| other.child == step.child)
        });
        let bounds: Vec<[f64; 2]> = bounds.iter().map(|[a, b]| [a.min(*b), a.max(*b)]).collect();
        let mut uses: Vec<Option<RangeKind>> = vec![None; kinematics.num_dofs()];
        let mut vectors = Vec::new();
        for step in branch.steps.iter().copied().chain(tied) {
            let kinds: &[RangeKind] = match &step.motion {
                Motion::Fixed => &[],
                Motion::Turn { position, .. } if position.multiplier == 1.0 => &[Turning],
                Motion::Turn { .. } | Motion::Slide { .. } => &[Bounded],
                Motion::Plane { .. } => &[Bounded, Bounded, Turning],
                Motion::Float { dofs: [_, _, _, vector @ ..] } => {
                    vectors.push(*vector);
                    &[Bounded, Bounded, Bounded, Free, Free, Free]
                }
                Motion::Ball { dofs } => {
                    vectors.push(*dofs);
                    &[Free; 3]
                }
            };
            for (dof, kind) in step.motion.dofs().iter().zip(kinds) {
                // A DOF that drives several joints does not repeat with whole turns.
                uses[*dof] = Some(uses[*dof].map_or(*kind, |_| Bounded));
            }
        }
        // A coupling does not repeat with whole turns.
        for dof in loops.into_iter().flat_map(Loops::coupled) {
            uses[dof] = uses[dof].map(|kind| if kind == Turning { Bounded } else { kind });
            vectors.retain(|dofs: &[usize; 3]| !dofs.contains(&dof));
        }
        let mut path = Self {
            branch,
            point: goal.point,
            dofs: Vec::new(),
            place: vec![None; uses.len()],
            bounds,
            kinds: Vec::new(),
            vectors,
        };
        for (dof, kind) in uses.iter().enumerate() {
            let [lower, upper] = path.bounds[dof];
            if let Some(kind) = kind
                && lower < upper
            {
                path.place[dof] = Some(path.dofs.len());
                path.dofs.push(dof);
                path.kinds.push(*kind);
            }
        }
        // A rotation vector with a locked component has no equivalents.
        path.vectors.retain(|dofs| dofs.iter().all(|dof| path.place[*dof].is_some()));
        path
    }

    /// The beginning of another descent: with other values of the DOFs that move the link.
    pub fn restarted(&self, first: &[f64], other: &[f64]) -> Vec<f64> {
        let mut begin = first.to_vec();
        for &dof in &self.dofs {
            begin[dof] = other[dof];
        }
        self.confine(&mut begin);
        begin
    }

    /// The Euclidean distance of two configurations in the DOFs that move the link.
    pub fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let squares = self.dofs.iter().map(|dof| (a[*dof] - b[*dof]).powi(2));
        squares.sum::<f64>().sqrt()
    }

    /// Bounds within which every pose of the link is that without any limit: whole turns, and slides that are longer
    /// than the way to the goal.
    pub fn unlimited(&self, bounds: &[[f64; 2]], way: f64) -> Vec<[f64; 2]> {
        let mut wide = bounds.to_vec();
        for (dof, kind) in self.dofs.iter().zip(&self.kinds) {
            let [lower, upper] = bounds[*dof];
            wide[*dof] = match kind {
                RangeKind::Turning if upper - lower < TAU => [-PI, PI],
                RangeKind::Bounded => [lower - way.max(TAU), upper + way.max(TAU)],
                _ => [lower, upper],
            };
        }
        wide
    }

    /// The bounds of all DOFs, lower bound first.
    pub fn all_bounds(&self) -> &[[f64; 2]] {
        &self.bounds
    }

    /// Bounds of one of `dofs`.
    pub fn bounds(&self, k: usize) -> [f64; 2] {
        self.bounds[self.dofs[k]]
    }

    /// Where a DOF goes that is to go to a value, and whether a bound stops it on the way.
    pub fn moved(&self, k: usize, to: f64) -> (f64, bool) {
        let (kind, bounds) = (self.kinds[k], self.bounds(k));
        if kind == RangeKind::Free {
            return (to, false);
        }
        let moved = within(to, bounds, kind == RangeKind::Turning);
        (moved, bounds.contains(&moved) && moved != to)
    }

    /// Moves each value that is out of bounds by whole turns if possible, otherwise to the nearest bound.
    pub fn confine(&self, configuration: &mut [f64]) {
        for (dof, value) in configuration.iter_mut().enumerate() {
            let kind = self.place[dof].map(|k| self.kinds[k]);
            if kind != Some(RangeKind::Free) {
                *value = within(*value, self.bounds[dof], kind == Some(RangeKind::Turning));
            }
        }
        self.wrap(configuration);
    }

    /// Replaces each rotation vector by the equivalent one of at most a half turn.
    pub fn wrap(&self, configuration: &mut [f64]) {
        self.turn_vectors(configuration, |_| Vector3::zeros());
    }

    /// Replaces angles that repeat with whole turns, and rotation vectors, by the equivalents that are nearest to those
    /// of another configuration: angles within their bounds.
    pub fn settle(&self, configuration: &mut [f64], near: &[f64]) {
        for (k, dof) in self.dofs.iter().enumerate() {
            if self.kinds[k] == RangeKind::Turning {
                let ([lower, upper], value) = (self.bounds(k), configuration[*dof]);
                let turns = |to: f64| (to - value) / TAU;
                let nearest = whole(turns(near[*dof]));
                let nearest = nearest.max(turns(lower).ceil()).min(turns(upper).floor());
                configuration[*dof] = (value + TAU * nearest).max(lower).min(upper);
            }
        }
        self.turn_vectors(configuration, |dofs| Vector3::from(dofs.map(|dof| near[dof])));
    }

    /// Replaces each rotation vector by the equivalent one along its axis that is nearest to another.
    fn turn_vectors(&self, configuration: &mut [f64], near: impl Fn([usize; 3]) -> Vector3<f64>) {
        for dofs in &self.vectors {
            let vector = Vector3::from(dofs.map(|dof| configuration[dof]));
            let angle = vector.norm();
            let turns = whole((vector.dot(&near(*dofs)) / angle - angle) / TAU);
            if turns.is_finite() && turns != 0.0 {
                for dof in dofs {
                    configuration[*dof] *= (angle + TAU * turns) / angle;
                }
            }
        }
    }

    /// Computes the link's pose; returns the point in the root link's frame.
    pub fn place(&self, configuration: &[f64], place: &mut Place) -> Point3<f64> {
        self.branch.place(configuration, place);
        place.pose * self.point
    }

    /// The linear and angular velocity of the point for each of `dofs`.
    pub fn jacobian(&self, configuration: &[f64], place: &Place, jacobian: &mut Vec<Vector6<f64>>) {
        jacobian.clear();
        jacobian.resize(self.dofs.len(), Vector6::zeros());
        let point = place.pose * self.point;
        for (step, (frame, child)) in self.branch.steps.iter().zip(&place.joints) {
            columns(step, frame, child, &point, configuration, |dof, linear, angular| {
                if let Some(k) = self.place[dof] {
                    add_to(jacobian[k].as_mut_slice(), linear, angular);
                }
            });
        }
    }

    /// Approximate maximum distance of the point from the first joint, metres.
    pub fn reach(&self) -> f64 {
        let shifts =
            self.branch.steps.iter().skip(1).map(|step| step.origin.translation.vector.norm());
        shifts.sum::<f64>() + self.point.coords.norm()
    }
}

/// The nearest whole number of turns; 0 for a half turn either way.
fn whole(turns: f64) -> f64 {
    if turns.abs() <= 0.5 { 0.0 } else { turns.round() }
}

/// The value within bounds: shifted by whole turns if `turning` and possible, otherwise clamped to the nearest bound.
fn within(value: f64, [lower, upper]: [f64; 2], turning: bool) -> f64 {
    if turning && !(lower..=upper).contains(&value) {
        let turned = value - TAU * ((value - 0.5 * (lower + upper)) / TAU).round();
        if (lower..=upper).contains(&turned) {
            return turned;
        }
    }
    value.max(lower).min(upper)
}
