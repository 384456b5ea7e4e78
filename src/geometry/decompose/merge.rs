//! Joining blocks again where their common hull adds little air.
//!
//! Greedy pairwise merging, as in Mamou and Ghorbel, "A simple and efficient approach for 3D mesh
//! approximate convex decomposition" (ICIP 2009). A join's price is what the common hull has beyond
//! the union of the two: V(hull) - V(a) - V(b) + V(a and b). The last term is counted on fixed sample
//! points: without it, blocks that overlap would seem to gain by being joined.

use rayon::prelude::*;

use super::grower::{Bounds, cost};
use super::search::Block;

/// Sample points for overlaps, in words of 64.
const WORDS: usize = 32;

/// A block or several joined, with the sample points inside.
#[derive(Clone)]
struct Group {
    block: Block,
    points: Vec<[f64; 3]>,
    inside: [u64; WORDS],
}

/// Points of a low-discrepancy sequence (R3: Roberts, "The unreasonable effectiveness of quasirandom
/// sequences", 2018) in a box, and the volume that each stands for.
struct Samples {
    points: Vec<[f64; 3]>,
    weight: f64,
}

impl Samples {
    fn new(bounds: &Bounds) -> Self {
        // Powers of 1/g, with g the root of g^4 = g + 1.
        const STEPS: [f64; 3] = [
            0.819_172_513_396_164_4,
            0.671_043_606_703_789_2,
            0.549_700_477_901_970_3,
        ];
        let size = [0, 1, 2].map(|a| bounds.high[a] - bounds.low[a]);
        let count = WORDS * 64;
        let points = (1..=count)
            .map(|k| {
                [0, 1, 2].map(|a| bounds.low[a] + size[a] * (0.5 + k as f64 * STEPS[a]).fract())
            })
            .collect();
        Samples {
            points,
            weight: size.iter().product::<f64>() / count as f64,
        }
    }

    fn group(&self, block: Block) -> Group {
        let hull = &block.hull.hull;
        let points: Vec<[f64; 3]> = hull.used().iter().map(|&i| hull.points[i]).collect();
        let bounds = Bounds::new(&points);
        let mut inside = [0; WORDS];
        for (k, &p) in self.points.iter().enumerate() {
            let near = (0..3).all(|a| p[a] > bounds.low[a] && p[a] < bounds.high[a]);
            if near && hull.farthest_face(p).1 < 0.0 {
                inside[k / 64] |= 1 << (k % 64);
            }
        }
        Group {
            block,
            points,
            inside,
        }
    }

    /// What the common hull holds beyond the two, and that hull.
    fn price(&self, a: &Group, b: &Group) -> (f64, Block) {
        let (large, small) = if a.block.cost >= b.block.cost {
            (a, b)
        } else {
            (b, a)
        };
        let mut hull = large.block.hull.clone();
        for &p in &small.points {
            hull.hull.insert(p, small.block.hull.step);
        }
        let both: u32 = a
            .inside
            .iter()
            .zip(&b.inside)
            .map(|(x, y)| (x & y).count_ones())
            .sum();
        let cost = cost(&hull.hull);
        (
            cost - a.block.cost - b.block.cost + f64::from(both) * self.weight,
            Block { hull, cost },
        )
    }
}

/// For each block its group, 0, 1, …, numbered in the order of their first blocks. Merges go on
/// while there are more than `most` groups or the cheapest costs at most `free`.
pub(super) fn merge(blocks: Vec<Block>, most: usize, free: f64) -> Vec<usize> {
    let n = blocks.len();
    let hulls = blocks
        .iter()
        .flat_map(|b| &b.hull.hull.points)
        .copied()
        .collect::<Vec<_>>();
    let samples = Samples::new(&Bounds::new(&hulls));
    let mut group: Vec<usize> = (0..n).collect();
    let mut alive: Vec<Option<Group>> = blocks
        .into_par_iter()
        .map(|b| Some(samples.group(b)))
        .collect();
    let price = |a: &Option<Group>, b: &Option<Group>| match (a, b) {
        (Some(a), Some(b)) => samples.price(a, b).0,
        _ => f64::INFINITY,
    };
    let mut prices = vec![f64::INFINITY; n * n];
    let pairs: Vec<(usize, usize)> = (0..n)
        .flat_map(|i| (i + 1..n).map(move |j| (i, j)))
        .collect();
    let first: Vec<f64> = pairs
        .par_iter()
        .map(|&(i, j)| price(&alive[i], &alive[j]))
        .collect();
    for (&(i, j), p) in pairs.iter().zip(first) {
        prices[i * n + j] = p;
    }
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
        if !p.is_finite() || (left <= most && p > free) {
            break;
        }
        let (Some(a), Some(b)) = (alive[i].take(), alive[j].take()) else {
            break;
        };
        let joined = Some(samples.group(samples.price(&a, &b).1));
        group.iter_mut().filter(|g| **g == j).for_each(|g| *g = i);
        for k in 0..n {
            prices[k.min(j) * n + k.max(j)] = f64::INFINITY;
        }
        let fresh: Vec<f64> = (0..n)
            .into_par_iter()
            .map(|k| price(&joined, &alive[k]))
            .collect();
        for (k, p) in fresh.into_iter().enumerate().filter(|&(k, _)| k != i) {
            prices[k.min(i) * n + k.max(i)] = p;
        }
        alive[i] = joined;
        left -= 1;
    }
    let mut names = vec![usize::MAX; n];
    let mut next = 0;
    group
        .iter()
        .map(|&g| {
            if names[g] == usize::MAX {
                names[g] = next;
                next += 1;
            }
            names[g]
        })
        .collect()
}
