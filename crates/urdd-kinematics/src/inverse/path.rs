//! The joints and DOFs that move one link.

use std::f64::consts::{PI, TAU};

use nalgebra::{Point3, Vector3, Vector6};

use super::goal::Goal;
use crate::branch::{Branch, Place};
use crate::forward::ForwardKinematics;
use crate::jacobian::{add_to, columns};
use crate::joint::Motion;

/// The joints from the root to a link, and the DOFs that move it.
pub(super) struct Path<'a> {
    branch: Branch<'a>,
    /// A point of the link, in its frame.
    point: Point3<f64>,
    /// The DOFs that move the link and are not fixed by their bounds, ascending.
    pub dofs: Vec<usize>,
    /// For each DOF of the robot, its index in `dofs`.
    place: Vec<Option<usize>>,
    /// The bounds of all DOFs, lower bound first.
    bounds: Vec<[f64; 2]>,
    /// The range of values of each of `dofs`.
    pub kinds: Vec<Kind>,
    /// The DOFs of rotation vectors.
    vectors: Vec<[usize; 3]>,
}

/// The range of values of a DOF.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Within the bounds.
    Bounded,
    /// Within the bounds; whole turns are equivalent.
    Turning,
    /// Unbounded: a component of a rotation vector.
    Free,
}

impl<'a> Path<'a> {
    pub fn new(kinematics: &'a ForwardKinematics, goal: &Goal, bounds: &[[f64; 2]]) -> Self {
        use Kind::{Bounded, Free, Turning};
        let branch = kinematics.branch(goal.link);
        let bounds: Vec<[f64; 2]> = bounds.iter().map(|[a, b]| [a.min(*b), a.max(*b)]).collect();
        let mut uses: Vec<Option<Kind>> = vec![None; kinematics.num_dofs()];
        let mut vectors = Vec::new();
        for step in &branch.steps {
            let kinds: &[Kind] = match &step.motion {
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
                Kind::Turning if upper - lower < TAU => [-PI, PI],
                Kind::Bounded => [lower - way.max(TAU), upper + way.max(TAU)],
                _ => [lower, upper],
            };
        }
        wide
    }

    /// Bounds of one of `dofs`.
    pub fn bounds(&self, k: usize) -> [f64; 2] {
        self.bounds[self.dofs[k]]
    }

    /// Moves each value that is out of bounds by whole turns if possible, otherwise to the nearest bound.
    pub fn confine(&self, configuration: &mut [f64]) {
        for (dof, value) in configuration.iter_mut().enumerate() {
            let kind = self.place[dof].map(|k| self.kinds[k]);
            if kind != Some(Kind::Free) {
                *value = within(*value, self.bounds[dof], kind == Some(Kind::Turning));
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
            if self.kinds[k] == Kind::Turning {
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
pub(super) fn within(value: f64, [lower, upper]: [f64; 2], turning: bool) -> f64 {
    if turning && !(lower..=upper).contains(&value) {
        let turned = value - TAU * ((value - 0.5 * (lower + upper)) / TAU).round();
        if (lower..=upper).contains(&turned) {
            return turned;
        }
    }
    value.max(lower).min(upper)
}
