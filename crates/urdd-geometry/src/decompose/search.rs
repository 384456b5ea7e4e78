//! The search for cuts: a tree of planes that grows by the best cut of all leaves.

use rayon::join;
use rayon::prelude::*;

use super::cut::{Cut, best_cuts};
use super::faces;
use super::grower::{AXES, Grower, Places, bulk};
use super::part::{Part, Plane};
use super::tree::{Node, divide};

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
    /// Best first.
    cuts: Vec<Cut>,
    node: usize,
}

impl Leaf {
    fn new(part: Part, places: &Places) -> Self {
        let (mut hull, cuts) = best_cuts(&part, places);
        let block = Block {
            standoff: places.standoff(&mut hull, &AXES, &part.cuts),
            hull,
            cuts: part.cuts.clone(),
        };
        Leaf {
            part,
            block,
            cuts,
            node: 0,
        }
    }

    /// The remaining cost after its best cut.
    fn promise(&self) -> f64 {
        let gain = self.cuts.iter().map(|c| c.gain).fold(0.0, f64::max);
        self.block.cost() - gain
    }

    /// The two leaves of a cut; `None` if one of them has no surface.
    fn split(&self, cut: &Cut, places: &Places) -> Option<[Leaf; 2]> {
        let [below, above] = self.part.split(&cut.plane, places.eps, places.reach);
        if below.triangles.is_empty() || above.triangles.is_empty() {
            return None;
        }
        let (below, above) = join(|| Leaf::new(below, places), || Leaf::new(above, places));
        Some([below, above])
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
    let faces::Cuts { nodes, parts } = faces::cut(part, places, limits.most)?;
    let leaves = parts.into_par_iter().map(|(part, node)| Leaf {
        node,
        ..Leaf::new(part, places)
    });
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
        let worth = |l: &Leaf| {
            let promise = |c: &Cut| c.gain.max(0.0) + POTENTIAL * l.block.cost();
            l.cuts.first().map_or(f64::NEG_INFINITY, promise)
        };
        let Some((k, _)) = leaves
            .iter()
            .enumerate()
            .map(|(k, l)| (k, worth(l)))
            .reduce(|a, b| if b.1 > a.1 { b } else { a })
            .filter(|&(_, w)| w > limits.fat * area)
        else {
            break;
        };
        let cuts = std::mem::take(&mut leaves[k].cuts);
        let leaf = &leaves[k];
        let poor = cuts[0].gain < POOR * leaf.block.cost();
        let tried = if poor && leaves.len() <= EARLY {
            WIDE
        } else {
            1
        };
        let made: Vec<(Plane, [Leaf; 2])> = cuts
            .par_iter()
            .take(tried)
            .filter_map(|cut| Some((cut.plane, leaf.split(cut, places)?)))
            .collect();
        let rest = |leaves: &[Leaf; 2]| leaves[0].promise() + leaves[1].promise();
        let Some((plane, [mut below, mut above])) = made
            .into_iter()
            .reduce(|a, b| if rest(&b.1) < rest(&a.1) { b } else { a })
        else {
            continue;
        };
        let sides = [k, leaves.len()];
        [below.node, above.node] = divide(&mut nodes, leaves[k].node, plane, sides);
        leaves[k] = below;
        leaves.push(above);
    }
    Search {
        area,
        nodes,
        leaves: leaves.into_iter().map(|l| l.block).collect(),
    }
}

/// Promise of a block without a good cut, as a fraction of its cost. Cuts that help only together (in a ring) are found
/// by continuing.
const POTENTIAL: f64 = 0.05;

/// A cut that saves less than this fraction of the cost is poor. While there are at most `EARLY` leaves, `WIDE`
/// alternatives of a poor cut are made. The one whose next cuts leave the least cost is kept.
const POOR: f64 = 0.5;
const EARLY: usize = 3;
const WIDE: usize = 2;
