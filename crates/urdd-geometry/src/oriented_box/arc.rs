//! Arcs: the normals about an edge of the hull.

use std::cmp::Ordering;

use nalgebra::Vector3;

use super::shadow::{Candidate, Caster, Edge};

/// What is known of the smallest box with some axis.
#[derive(Clone, Copy)]
pub struct Known {
    /// Its volume, or one that it is not below.
    pub volume: f64,
    /// See [`Candidate::steepness`].
    pub steepness: f64,
}

impl Known {
    pub const NOTHING: Self = Self {
        volume: f64::INFINITY,
        steepness: 0.0,
    };

    pub fn of(candidate: &Candidate) -> Self {
        Self {
            volume: candidate.volume,
            steepness: candidate.steepness,
        }
    }
}

/// A part of an arc.
pub struct Stretch {
    /// No box on the stretch is expected to be smaller.
    pub promise: f64,
    /// Which arc.
    pub arc: usize,
    /// Where it begins and ends: 0 and 1 are the ends of the arc.
    pub parts: [f64; 2],
    /// What is known of its ends.
    pub ends: [Known; 2],
}

impl Stretch {
    pub fn middle(&self) -> f64 {
        let [low, high] = self.parts;
        0.5 * (low + high)
    }

    /// The order of the queue: least promise first, then by place.
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
    /// At a right angle to `from`, towards the other end.
    towards: Vector3<f64>,
    /// From one end to the other, radians.
    pub angle: f64,
}

impl Arc {
    pub fn new(caster: &Caster, edge: &Edge) -> Self {
        let [from, to] = [edge.left, edge.right].map(|t| caster.normal(t as usize));
        let along = caster.along(edge);
        // Normals turn about the edge, also where they are nearly opposite.
        let mut towards = along.cross(&from);
        let sine = towards.dot(&to);
        if sine < 0.0 {
            towards = -towards;
        }
        Self {
            from,
            towards,
            angle: sine.abs().atan2(from.dot(&to)),
        }
    }

    /// From 0 at one end to 1 at the other.
    pub fn at(&self, part: f64) -> Vector3<f64> {
        let (sin, cos) = (self.angle * part.clamp(0.0, 1.0)).sin_cos();
        (self.from * cos + self.towards * sin).normalize()
    }
}
