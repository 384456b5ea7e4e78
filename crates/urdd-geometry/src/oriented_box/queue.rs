//! The queue of stretches to evaluate, most promising first.
//!
//! Shadows along several axes together take less work than one by one, and are independent. So the queue sketches the
//! middles of the next few stretches at once, without changing the order of evaluation.

use std::collections::BinaryHeap;

use nalgebra::Vector3;

use super::arc::Stretch;
use super::shadow::Candidate;

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
