//! Memory of queries on one configuration.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use arrayvec::ArrayVec;
use nalgebra::Isometry3;
use urdd_geometry::convex::across::AT_ONCE;

/// Memory for queries on one configuration, which the next query uses again. Then they do not allocate:
/// [`Proximity::in_collision_with`](super::Proximity::in_collision_with) and others. One for each thread; it fits every
/// robot and world.
#[derive(Debug, Default)]
pub struct Workspace {
    pub(crate) placed: Placed,
    pub(super) least: Least<usize>,
    /// For pairs of a shape and a part of an obstacle.
    pub(crate) least_of_parts: Least<(usize, usize)>,
}

/// The placement of all links in one configuration.
#[derive(Debug, Default)]
pub(crate) struct Placed {
    pub poses: Vec<Isometry3<f64>>,
    /// For each link, the columns of its rotation matrix, then its translation.
    pub links: Vec<[[f64; 3]; 4]>,
    /// The centre of each shape's bounding sphere.
    pub centres: Vec<[f64; 3]>,
}

/// A lower bound of a pair's distance, as its bits, and the pair.
type Bound<P> = Reverse<(u64, P)>;

/// A search of the nearest pairs.
#[derive(Debug)]
pub(crate) struct Least<P> {
    bounds: Vec<Bound<P>>,
    best: Vec<(f64, P)>,
}

impl<P> Default for Least<P> {
    fn default() -> Self {
        let (bounds, best) = (Vec::new(), Vec::new());
        Least { bounds, best }
    }
}

impl<P: Ord + Copy> Least<P> {
    /// The `k` nearest pairs, nearest first, from lower bounds of their distances. Ties are in the order of the pairs.
    /// `values` computes the distances of some pairs, at most [`AT_ONCE`].
    pub fn of(
        &mut self,
        bounds: impl Iterator<Item = (f64, P)>,
        k: usize,
        values: impl Fn(&[P], &mut [f64]),
    ) -> &[(f64, P)] {
        self.best.clear();
        self.bounds.clear();
        // A heap, as a few of the pairs are enough. The bits of numbers that are not negative have their order.
        self.bounds
            .extend(bounds.map(|(bound, pair)| Reverse(((bound.max(0.0) + 0.0).to_bits(), pair))));
        self.best.reserve(k.min(self.bounds.len()) + AT_ONCE);
        let mut heap = BinaryHeap::from(std::mem::take(&mut self.bounds));
        let best = &mut self.best;
        while let Some(Reverse((least, _))) = heap.peek() {
            // No pair in the heap can be nearer than the worst of `k` results, or equal to it and earlier in order.
            let least = f64::from_bits(*least);
            if best.len() >= k && best.last().is_none_or(|worst| least > worst.0) {
                break;
            }
            let next = std::iter::from_fn(|| heap.pop()).take(AT_ONCE);
            let pairs: ArrayVec<P, AT_ONCE> = next.map(|Reverse((_, pair))| pair).collect();
            let mut found = [0.0; AT_ONCE];
            values(&pairs, &mut found[..pairs.len()]);
            best.extend(found.into_iter().zip(pairs));
            best.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            best.truncate(k);
        }
        self.bounds = heap.into_vec();
        &self.best
    }
}
