//! Merges blocks if their common hull has little more standoff.
//!
//! Greedy pairwise merging, as in Mamou and Ghorbel, "A simple and efficient approach for 3D mesh approximate convex
//! decomposition" (ICIP 2009). The price of a join is the cost of the common hull beyond that of the two hulls. Of
//! these, only what is outside the other hull counts. Otherwise overlapping blocks would seem to gain from a join.

use rayon::prelude::*;

use super::field::in_cut;
use super::part::{norm, normal};
use super::search::Block;
use super::slices::{AXES, Places, bulk};

/// One block, or several merged ones.
#[derive(Clone)]
struct Group {
    block: Block,
    points: Vec<[f64; 3]>,
    /// Sample points on its faces with standoff, each with its weight in the integral.
    standing: Vec<([f64; 3], f64)>,
}

/// Distance by which a face point is lifted before the test whether another hull contains it.
const LIFT: f64 = 1e-3;

impl Group {
    fn new(block: Block, places: &Places) -> Group {
        let hull = &block.hull.hull;
        let points = hull.used().iter().map(|&i| hull.points[i]).collect();
        let mut standing = Vec::new();
        for (_, corners, area) in hull.faces() {
            let corners = corners.map(|i| hull.points[i as usize]);
            if in_cut(corners, &block.cuts) {
                continue;
            }
            let normal = normal(corners);
            let lift = LIFT / norm(normal).max(f64::MIN_POSITIVE);
            let from = standing.len();
            let n = places.field.spread(corners, |p| {
                let far = places.field.at(p);
                if far > 0.0 {
                    standing.push(([0, 1, 2].map(|k| p[k] + lift * normal[k]), far * area));
                }
            });
            standing[from..].iter_mut().for_each(|s| s.1 /= n as f64);
        }
        Group { block, points, standing }
    }

    fn holds(&self, p: [f64; 3]) -> bool {
        self.block.hull.hull.farthest_face(p).1 <= 0.0
    }

    /// The standoff of its samples outside the other group.
    fn outside(&self, other: &Group) -> f64 {
        let outside = self.standing.iter().filter(|(p, _)| !other.holds(*p));
        outside.map(|(_, weight)| weight).sum()
    }

    /// Joins two groups, and computes the standoff and cost beyond theirs.
    fn join(&self, other: &Group, places: &Places) -> Join {
        let volume = |g: &Group| g.block.hull.hull.volume();
        let (large, small) =
            if volume(self) >= volume(other) { (self, other) } else { (other, self) };
        let mut hull = large.block.hull.clone();
        for &p in &small.points {
            hull.hull.insert(p, small.block.hull.step);
        }
        let mut cuts = large.block.cuts.clone();
        let more = small.block.cuts.iter();
        cuts.extend(more.filter(|c| !large.block.cuts.contains(c)));
        let standoff = places.standoff(&mut hull, &AXES, &cuts);
        let more = standoff - large.outside(small) - small.outside(large);
        let whole = bulk(&hull.hull);
        let parts = bulk(&large.block.hull.hull) + bulk(&small.block.hull.hull);
        Join {
            standoff: more,
            price: more + whole - parts,
            filled: hull.hull.volume() - volume(large) - volume(small),
            block: Block { hull, standoff, cuts },
        }
    }
}

/// Two groups joined.
struct Join {
    block: Block,
    /// Its standoff beyond that of the two.
    standoff: f64,
    /// Its cost beyond theirs.
    price: f64,
    /// Its volume beyond theirs.
    filled: f64,
}

/// The integral of distances from the surface over the groups' outside.
fn standoff(groups: &[Option<Group>]) -> f64 {
    let groups: Vec<&Group> = groups.iter().flatten().collect();
    let mut sum = 0.0;
    for (i, group) in groups.iter().enumerate() {
        for (p, weight) in &group.standing {
            let mut others = groups.iter().enumerate().filter(|&(j, _)| j != i);
            if others.all(|(_, other)| !other.holds(*p)) {
                sum += weight;
            }
        }
    }
    sum
}

/// A join is not free if its added volume exceeds the free cost times this factor.
const FILLED: f64 = 10.0;

/// Termination criteria of merging.
pub(super) struct Limits {
    /// Maximum number of groups.
    pub most: usize,
    /// A join that costs at most this is always made.
    pub free: f64,
    /// A join is also made if the total standoff after it is at most this.
    pub enough: f64,
}

/// The grouping of the blocks.
pub(super) struct Groups {
    /// For each block, its group: 0, 1, …, in the order of their first blocks.
    pub of: Vec<usize>,
    /// The integral of distances from the surface over the groups' outside.
    pub standoff: f64,
    /// The standoff plus the bulk of the groups' hulls.
    pub cost: f64,
}

/// Merges blocks, the cheapest pair first.
pub(super) fn merge(blocks: Vec<Block>, places: &Places, limits: &Limits) -> Groups {
    let n = blocks.len();
    let mut group: Vec<usize> = (0..n).collect();
    let mut alive: Vec<Option<Group>> =
        blocks.into_par_iter().map(|b| Some(Group::new(b, places))).collect();
    let price = |a: &Option<Group>, b: &Option<Group>| match (a, b) {
        (Some(a), Some(b)) => a.join(b, places).price,
        _ => f64::INFINITY,
    };
    let mut prices = vec![f64::INFINITY; n * n];
    let pairs: Vec<(usize, usize)> = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).collect();
    let first: Vec<f64> = pairs.par_iter().map(|&(i, j)| price(&alive[i], &alive[j])).collect();
    for (&(i, j), p) in pairs.iter().zip(first) {
        prices[i * n + j] = p;
    }
    let mut total = if limits.enough > 0.0 { standoff(&alive) } else { f64::INFINITY };
    let mut left = n;
    while left > 1 {
        let mut best = (f64::INFINITY, 0, 0);
        for i in 0..n {
            for j in i + 1..n {
                if prices[i * n + j] < best.0 {
                    best = (prices[i * n + j], i, j);
                }
            }
        }
        let (p, i, j) = best;
        let (Some(a), Some(b)) = (&alive[i], &alive[j]) else { break };
        let join = a.join(b, places);
        total += join.standoff;
        // Blocks around a hollow seem to gain from a join if they protrude into it. The volume test keeps a lid
        // expensive.
        let free = p <= limits.free && join.filled <= FILLED * limits.free;
        if left <= limits.most && !free && total > limits.enough {
            break;
        }
        (alive[i], alive[j]) = (None, None);
        let joined = Some(Group::new(join.block, places));
        group.iter_mut().filter(|g| **g == j).for_each(|g| *g = i);
        for k in 0..n {
            prices[k.min(j) * n + k.max(j)] = f64::INFINITY;
        }
        let fresh: Vec<f64> = (0..n).into_par_iter().map(|k| price(&joined, &alive[k])).collect();
        for (k, p) in fresh.into_iter().enumerate().filter(|&(k, _)| k != i) {
            prices[k.min(i) * n + k.max(i)] = p;
        }
        alive[i] = joined;
        left -= 1;
    }
    // So far a group has the number of its first block.
    let of = group.iter().map(|g| (0..*g).filter(|k| group[*k] == *k).count()).collect();
    let standoff = standoff(&alive);
    let hulls = alive.iter().flatten().map(|g| bulk(&g.block.hull.hull));
    Groups { of, standoff, cost: standoff + hulls.sum::<f64>() }
}
