//! What a thread keeps from one query to the next, so that queries on one configuration do not allocate.

use std::cell::RefCell;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::thread::LocalKey;

use arrayvec::ArrayVec;
use nalgebra::Isometry3;
use urdd_geometry::convex::across::AT_ONCE;
use urdd_kinematics::Load;
use urdd_kinematics::loops::{Scratch, VelocityScratch};

/// Memory for queries on one configuration. It fits every robot and world.
#[derive(Debug, Default)]
pub(crate) struct Workspace {
    pub placed: Placed,
    pub least: Least,
    pub derivative: Derivative,
    /// What each link carries.
    pub loads: Vec<Load>,
}

/// Memory for closing loops.
#[derive(Debug, Default)]
pub(crate) struct ClosingSpace {
    pub scratch: Scratch,
    /// Whether each DOF stays.
    pub held: Vec<bool>,
    pub velocities: VelocityScratch,
}

thread_local! {
    static WORKSPACE: RefCell<Workspace> = RefCell::default();
    static CLOSING: RefCell<ClosingSpace> = RefCell::default();
}

/// Runs with this thread's memory. A query within a query gets memory of its own, and so does one of a thread that is
/// ending, which keeps nothing any more.
pub(crate) fn with_workspace<T>(act: impl FnOnce(&mut Workspace) -> T) -> T {
    with(&WORKSPACE, act)
}

/// As [`with_workspace`], to close loops.
pub(crate) fn with_closing_space<T>(act: impl FnOnce(&mut ClosingSpace) -> T) -> T {
    with(&CLOSING, act)
}

fn with<M: Default, T>(kept: &'static LocalKey<RefCell<M>>, act: impl FnOnce(&mut M) -> T) -> T {
    let mut memory = kept.try_with(RefCell::take).unwrap_or_default();
    let found = act(&mut memory);
    let _ = kept.try_with(|kept| kept.replace(memory));
    found
}

/// The derivative of a distance for each DOF, and the Jacobian of a point.
#[derive(Debug, Default)]
pub(crate) struct Derivative {
    pub jacobian: Vec<f64>,
    pub of_dofs: Vec<f64>,
}

/// The placement of all links in one configuration.
#[derive(Debug, Default)]
pub struct Placed {
    pub poses: Vec<Isometry3<f64>>,
    /// For each link, the columns of its rotation matrix, then its translation.
    pub links: Vec<[[f64; 3]; 4]>,
    /// The centre of each shape's bounding sphere.
    pub centres: Vec<[f64; 3]>,
    /// For each link, the centre of the bounding sphere of its shapes; 0 without shapes.
    pub around: Vec<[f64; 3]>,
}

/// A search of the nearest pairs. The bits of numbers that are not negative have their order.
#[derive(Debug, Default)]
pub(crate) struct Least {
    /// Lower bounds of distances, and the pairs.
    bounds: Vec<Reverse<(u64, usize)>>,
    /// The nearest that are known.
    known: Vec<(u64, usize)>,
    best: Vec<(f64, usize)>,
}

impl Least {
    /// The `k` nearest of `count` pairs, nearest first. Ties are in the order of the pairs. `groups` has a lower bound of the
    /// distances of each group of pairs, `members` calls back with the pairs of a group and their lower bounds, and `values`
    /// computes the distances of some pairs, at most [`AT_ONCE`].
    pub fn of(
        &mut self,
        (count, k): (usize, usize),
        groups: impl Iterator<Item = f64>,
        members: impl Fn(usize, &mut dyn FnMut(f64, usize)),
        values: impl Fn(&[usize], &mut [f64]),
    ) -> &[(f64, usize)] {
        let bits = |distance: f64| (distance.max(0.0) + 0.0).to_bits();
        self.bounds.clear();
        self.known.clear();
        // Heaps: as a few of the pairs are enough, and `k` may be all of them. Groups come after the pairs.
        let groups = groups.enumerate();
        self.bounds.extend(groups.map(|(group, bound)| Reverse((bits(bound), count + group))));
        self.bounds.reserve(count);
        self.known.reserve(k.min(count) + 1);
        let mut heap = BinaryHeap::from(std::mem::take(&mut self.bounds));
        let mut known = BinaryHeap::from(std::mem::take(&mut self.known));
        let mut pairs: ArrayVec<usize, AT_ONCE> = ArrayVec::new();
        loop {
            pairs.clear();
            // No pair can be nearer than the worst of `k` results, or equal to it and earlier in order, beyond this.
            let worst = match known.peek() {
                Some((worst, _)) if known.len() >= k => *worst,
                _ if k == 0 => break,
                _ => u64::MAX,
            };
            while !pairs.is_full() {
                let Some(next) = heap.peek().filter(|Reverse((bound, _))| *bound <= worst) else {
                    break;
                };
                let Reverse((_, place)) = *next;
                heap.pop();
                match place.checked_sub(count) {
                    None => pairs.push(place),
                    Some(group) => members(group, &mut |bound, pair| {
                        if bits(bound) <= worst {
                            heap.push(Reverse((bits(bound), pair)));
                        }
                    }),
                }
            }
            if pairs.is_empty() {
                break;
            }
            let mut found = [0.0; AT_ONCE];
            values(&pairs, &mut found[..pairs.len()]);
            for (value, pair) in found.into_iter().zip(&pairs) {
                known.push((bits(value), *pair));
                if known.len() > k {
                    known.pop();
                }
            }
        }
        self.bounds = heap.into_vec();
        self.known = known.into_sorted_vec();
        self.best.clear();
        self.best.extend(self.known.iter().map(|(value, pair)| (f64::from_bits(*value), *pair)));
        &self.best
    }

    /// The nearest pairs that were found last.
    pub fn best(&self) -> impl Iterator<Item = usize> {
        self.best.iter().map(|(_, pair)| *pair)
    }
}
