//! The search for cuts, a tree of planes that grows by the best cut of all leaves, and the merging of its blocks.
//!
//! Blocks are merged if their common hull has little more standoff.
//!
//! Greedy pairwise merging, as in Mamou and Ghorbel, "A simple and efficient approach for 3D mesh approximate convex
//! decomposition" (ICIP 2009). The price of a join is the cost of the common hull beyond that of the two hulls. Of
//! these, only what is outside the other hull counts. Otherwise overlapping blocks would seem to gain from a join.

use rayon::join;
use rayon::prelude::*;

use crate::decompose::cut::{self, Cut, best_cuts, first_cuts};
use crate::decompose::field::in_cut;
use crate::decompose::part::{Node, Part, Plane, divide, norm, normal};
use crate::decompose::slices::{AXES, Grower, Places, bulk};

/// A leaf's hull in the search.
#[derive(Clone)]
pub(super) struct Block {
    pub hull: Grower,
    pub standoff: f64,
    /// The planes that bound it.
    pub cuts: Vec<Plane>,
}

impl Block {
    /// Standoff and bulk.
    pub fn cost(&self) -> f64 {
        self.standoff + bulk(&self.hull.hull)
    }
}

struct Leaf {
    part: Part,
    block: Block,
    /// The cuts along all directions, best first; those along the first direction alone, unless `has_all`.
    cuts: Vec<Cut>,
    /// Most of a search's time goes into the cuts of parts, and most parts are never cut further. So all cuts are found
    /// when they are needed.
    has_all: bool,
    node: usize,
}

impl Leaf {
    fn new(part: Part, places: &Places) -> Self {
        let (mut hull, cuts) = first_cuts(&part, places);
        let block = Block {
            standoff: places.standoff(&mut hull, &AXES, &part.cuts),
            hull,
            cuts: part.cuts.clone(),
        };
        let has_all = cuts.is_none();
        Leaf { part, block, cuts: cuts.unwrap_or_default(), has_all, node: 0 }
    }

    /// Finds all cuts, best first.
    fn find_all(&mut self, places: &Places) {
        if !self.has_all {
            self.cuts = best_cuts(&self.part, &self.cuts, places);
            self.has_all = true;
        }
    }

    /// What its best cut promises to save; before the cuts are found, a number that is no less.
    fn worth(&self) -> f64 {
        let potential = POTENTIAL * self.block.cost();
        if !self.has_all {
            // No cut saves more than the whole cost.
            return self.block.cost() + potential;
        }
        self.cuts.first().map_or(f64::NEG_INFINITY, |cut| cut.gain.max(0.0) + potential)
    }

    /// The remaining cost after its best cut.
    fn promise(&mut self, places: &Places) -> f64 {
        self.find_all(places);
        self.block.cost() - self.cuts.iter().map(|c| c.gain).fold(0.0, f64::max)
    }

    /// The two leaves of a cut; `None` if one of them has no surface.
    fn split(&self, cut: &Cut, places: &Places) -> Option<[Leaf; 2]> {
        places.split(&self.part, &cut.plane, |part| Leaf::new(part, places))
    }
}

/// The nodes (the first is the root) and leaves; the area of the whole hull.
pub(super) struct Search {
    pub area: f64,
    pub nodes: Vec<Node>,
    pub leaves: Vec<Block>,
}

/// Termination criteria of the search.
pub(super) struct Limits {
    pub most: usize,
    /// Minimum promise of a cut, relative to the area of the whole hull.
    pub fat: f64,
    /// Sufficient standoff of all blocks together, relative to that area.
    pub enough: f64,
}

/// Cuts the part into blocks.
pub(super) fn search(part: Part, places: &Places, limits: &Limits) -> Search {
    let leaf = Leaf::new(part, places);
    let area = leaf.block.hull.hull.area();
    grow(vec![Node::Leaf(0)], vec![leaf], area, places, limits)
}

/// Cuts the part along its deep flat faces, then continues like [`search`]. `None` unless everything deep is flat.
/// `area` is that of the whole hull.
pub(super) fn along_faces(
    part: Part,
    area: f64,
    places: &Places,
    limits: &Limits,
) -> Option<Search> {
    let (nodes, parts) = cut::along_faces(part, places, limits.most)?;
    let leaves = parts.into_par_iter().map(|(part, node)| Leaf { node, ..Leaf::new(part, places) });
    Some(grow(nodes, leaves.collect(), area, places, limits))
}

/// Continues to cut the leaves of a tree, the most promising first.
fn grow(
    mut nodes: Vec<Node>,
    mut leaves: Vec<Leaf>,
    area: f64,
    places: &Places,
    limits: &Limits,
) -> Search {
    let standoff = |leaves: &[Leaf]| leaves.iter().map(|l| l.block.standoff).sum::<f64>();
    while leaves.len() < limits.most && standoff(&leaves) > limits.enough * area {
        let worth = leaves.iter().enumerate().map(|(k, l)| (k, l.worth()));
        let best = worth.reduce(|a, b| if b.1 > a.1 { b } else { a });
        let Some((k, _)) = best.filter(|&(_, worth)| worth > limits.fat * area) else { break };
        if !leaves[k].has_all {
            leaves[k].find_all(places);
            continue;
        }
        let cuts = std::mem::take(&mut leaves[k].cuts);
        let leaf = &leaves[k];
        let poor = cuts[0].gain < POOR * leaf.block.cost();
        let tried = if poor && leaves.len() <= EARLY { WIDE } else { 1 };
        let mut made: Vec<(Plane, [Leaf; 2])> = cuts
            .par_iter()
            .take(tried)
            .filter_map(|cut| Some((cut.plane, leaf.split(cut, places)?)))
            .collect();
        let mut best = 0;
        if made.len() > 1 {
            let rest = made.par_iter_mut().map(|(_, leaves)| {
                let [below, above] = leaves;
                let (below, above) = join(|| below.promise(places), || above.promise(places));
                below + above
            });
            let rest: Vec<f64> = rest.collect();
            best = (1..rest.len()).fold(0, |best, k| if rest[k] < rest[best] { k } else { best });
        }
        if made.is_empty() {
            continue;
        }
        let (plane, [mut below, mut above]) = made.swap_remove(best);
        let sides = [k, leaves.len()];
        [below.node, above.node] = divide(&mut nodes, leaves[k].node, plane, sides);
        leaves[k] = below;
        leaves.push(above);
    }
    Search { area, nodes, leaves: leaves.into_iter().map(|l| l.block).collect() }
}

/// Promise of a block without a good cut, as a fraction of its cost. Cuts that help only together (in a ring) are found
/// by continuing.
const POTENTIAL: f64 = 0.05;

/// A cut that saves less than this fraction of the cost is poor. While there are at most `EARLY` leaves, `WIDE`
/// alternatives of a poor cut are made. The one whose next cuts leave the least cost is kept.
const POOR: f64 = 0.5;
const EARLY: usize = 3;
const WIDE: usize = 2;

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
pub(super) struct MergeLimits {
    pub most: usize,
    /// A join that costs at most this is always made.
    pub free: f64,
    /// A join is also made if the total standoff after it is at most this.
    pub enough: f64,
}

pub(super) struct Groups {
    /// For each block, its group: 0, 1, …, in the order of their first blocks.
    pub of: Vec<usize>,
    /// The integral of distances from the surface over the groups' outside.
    pub standoff: f64,
    /// The standoff plus the bulk of the groups' hulls.
    pub cost: f64,
}

/// Merges blocks, the cheapest pair first.
pub(super) fn merge(blocks: Vec<Block>, places: &Places, limits: &MergeLimits) -> Groups {
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
