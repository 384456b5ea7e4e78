//! Arcs, the normals that rotate about an edge of the hull; and the queue of their stretches to evaluate, most promising
//! first.
//!
//! Shadows along several axes together take less work than one by one, and are independent. So the queue sketches the
//! middles of the next few stretches at once, without changing the order of evaluation.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use nalgebra::Vector3;

use super::shadow::{Candidate, Caster, Edge};

/// Known bounds for the smallest box with a given axis.
#[derive(Clone, Copy)]
pub struct Known {
    /// Its volume, or a lower bound.
    pub volume: f64,
    /// See [`Candidate::steepness`].
    pub steepness: f64,
}

impl Known {
    pub const NOTHING: Self = Self { volume: f64::INFINITY, steepness: 0.0 };

    pub fn of(candidate: &Candidate) -> Self {
        Self { volume: candidate.volume, steepness: candidate.steepness }
    }
}

/// A part of an arc.
pub struct Stretch {
    /// Expected lower bound of the volumes on the stretch.
    pub promise: f64,
    pub arc: usize,
    /// Start and end: 0 and 1 are the ends of the arc.
    pub parts: [f64; 2],
    pub ends: [Known; 2],
}

impl Stretch {
    pub fn middle(&self) -> f64 {
        let [low, high] = self.parts;
        0.5 * (low + high)
    }

    /// Sort key of the queue: lowest promise first, then by position.
    fn key(&self) -> (f64, usize, f64) {
        (self.promise, self.arc, self.parts[0])
    }
}

impl Ord for Stretch {
    fn cmp(&self, other: &Self) -> Ordering {
        let ((p, a, x), (q, b, y)) = (self.key(), other.key());
        q.total_cmp(&p).then(b.cmp(&a)).then(y.total_cmp(&x))
    }
}

impl PartialOrd for Stretch {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Stretch {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Stretch {}

/// The normals between those of the two triangles at an edge.
pub struct Arc {
    from: Vector3<f64>,
    /// Perpendicular to `from`, towards the other end.
    towards: Vector3<f64>,
    /// Between the ends, radians.
    pub angle: f64,
}

impl Arc {
    pub fn new(caster: &Caster, edge: &Edge) -> Self {
        let [from, to] = [edge.left, edge.right].map(|t| caster.normals[t as usize]);
        let along = caster.along(edge);
        // Normals rotate about the edge, even if they are nearly opposite.
        let mut towards = along.cross(&from);
        let sine = towards.dot(&to);
        if sine < 0.0 {
            towards = -towards;
        }
        Self { from, towards, angle: sine.abs().atan2(from.dot(&to)) }
    }

    /// The normal at a position from 0 at one end to 1 at the other.
    pub fn at(&self, part: f64) -> Vector3<f64> {
        let (sin, cos) = (self.angle * part.clamp(0.0, 1.0)).sin_cos();
        (self.from * cos + self.towards * sin).normalize()
    }
}

/// A stretch, and the boxes for the axis in its middle.
pub struct Sketched {
    pub stretch: Stretch,
    pub axis: Vector3<f64>,
    /// The box of the coarse hull if there is one, otherwise of the hull.
    pub sketch: Option<Candidate>,
    /// With a coarse hull: the box of the hull, once computed.
    pub fine: Option<Option<Candidate>>,
}

pub struct Queue {
    waiting: BinaryHeap<Stretch>,
    /// Sorted; the most promising is last.
    sketched: Vec<Sketched>,
}

impl Queue {
    pub fn new(stretches: impl Iterator<Item = Stretch>) -> Self {
        Self { waiting: stretches.collect(), sketched: Vec::new() }
    }

    pub fn extend(&mut self, stretches: [Stretch; 2]) {
        self.waiting.extend(stretches);
    }

    /// The most promising stretch, if its promise is below `limit`. If it is not sketched yet, sketches it together
    /// with the next ones, up to `ahead`. `axis` returns the axis in the middle of a stretch.
    pub fn pop(
        &mut self,
        limit: f64,
        ahead: usize,
        axis: impl Fn(&Stretch) -> Vector3<f64>,
        sketches: impl FnOnce(&[Vector3<f64>]) -> Vec<Option<Candidate>>,
    ) -> Option<Sketched> {
        let promises = |stretch: &Stretch| stretch.promise < limit;
        if self.waiting.peek() > self.sketched.last().map(|item| &item.stretch) {
            let mut next = Vec::with_capacity(ahead);
            while next.len() < ahead && self.waiting.peek().is_some_and(promises) {
                next.extend(self.waiting.pop());
            }
            if next.is_empty() {
                return None;
            }
            let axes: Vec<Vector3<f64>> = next.iter().map(axis).collect();
            let item = next.into_iter().zip(&axes).zip(sketches(&axes));
            self.sketched.extend(item.map(|((stretch, axis), sketch)| Sketched {
                stretch,
                axis: *axis,
                sketch,
                fine: None,
            }));
            self.sketched.sort_unstable_by(|a, b| a.stretch.cmp(&b.stretch));
        }
        self.sketched.pop_if(|item| promises(&item.stretch))
    }

    /// The sketched stretches, the most promising first.
    pub fn sketched(&mut self) -> impl Iterator<Item = &mut Sketched> {
        self.sketched.iter_mut().rev()
    }

    /// The remaining stretches, in any order.
    pub fn into_rest(self) -> Vec<Stretch> {
        let mut rest = self.waiting.into_vec();
        rest.extend(self.sketched.into_iter().map(|item| item.stretch));
        rest
    }
}
