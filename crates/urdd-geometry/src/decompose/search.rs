//! The search for cuts: a tree of planes that grows by the best cut of all leaves.

use rayon::join;
use rayon::prelude::*;

use super::cut::{self, Cut, best_cuts, first_cuts};
use super::part::{Node, Part, Plane, divide};
use super::slices::{AXES, Grower, Places, bulk};

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
    /// Maximum number of blocks.
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
