//! The stretches of arcs that are still to be looked at, most promising first.
//!
//! Shadows along several axes take less work together than one by one, and none depends on another. So the
//! middles of the next few stretches are sketched at once; the order in which stretches are looked at stays the same.

use std::collections::BinaryHeap;

use nalgebra::Vector3;

use super::arc::Stretch;
use super::shadow::Candidate;

/// A stretch, and the boxes with the axis in its middle.
pub struct Looked {
    pub stretch: Stretch,
    pub axis: Vector3<f64>,
    /// The box about the coarse hull or, where there is none, about the hull.
    pub sketch: Option<Candidate>,
    /// Where there is a coarse hull, the box about the hull, once it is worked out.
    pub fine: Option<Option<Candidate>>,
}

pub struct Queue {
    waiting: BinaryHeap<Stretch>,
    /// The most promising last.
    sketched: Vec<Looked>,
}

impl Queue {
    pub fn new(stretches: impl Iterator<Item = Stretch>) -> Self {
        Self {
            waiting: stretches.collect(),
            sketched: Vec::new(),
        }
    }

    pub fn extend(&mut self, stretches: [Stretch; 2]) {
        self.waiting.extend(stretches);
    }

    /// The most promising stretch, if it promises less than `limit`. Where it is not sketched, it is sketched together
    /// with those that come next, up to `ahead`: `axis` is that of a stretch's middle.
    pub fn pop(
        &mut self,
        limit: f64,
        ahead: usize,
        axis: impl Fn(&Stretch) -> Vector3<f64>,
        sketches: impl FnOnce(&[Vector3<f64>]) -> Vec<Option<Candidate>>,
    ) -> Option<Looked> {
        let promises = |stretch: &Stretch| stretch.promise < limit;
        if self.waiting.peek() > self.sketched.last().map(|looked| &looked.stretch) {
            let mut next = Vec::with_capacity(ahead);
            while next.len() < ahead && self.waiting.peek().is_some_and(promises) {
                next.extend(self.waiting.pop());
            }
            if next.is_empty() {
                return None;
            }
            let axes: Vec<Vector3<f64>> = next.iter().map(axis).collect();
            let looked = next.into_iter().zip(&axes).zip(sketches(&axes));
            self.sketched
                .extend(looked.map(|((stretch, axis), sketch)| Looked {
                    stretch,
                    axis: *axis,
                    sketch,
                    fine: None,
                }));
            self.sketched
                .sort_unstable_by(|a, b| a.stretch.cmp(&b.stretch));
        }
        self.sketched.pop_if(|looked| promises(&looked.stretch))
    }

    /// The stretches that are sketched, the most promising first.
    pub fn sketched(&mut self) -> impl Iterator<Item = &mut Looked> {
        self.sketched.iter_mut().rev()
    }

    /// The stretches that are left, in any order.
    pub fn into_rest(self) -> Vec<Stretch> {
        let mut rest = self.waiting.into_vec();
        rest.extend(self.sketched.into_iter().map(|looked| looked.stretch));
        rest
    }
}
