//! The search for cuts: a tree of planes, grown by the best cut anywhere.

use rayon::join;

use super::cut::{Cut, best_cut};
use super::grower::{Grower, Places, cost};
use super::part::{Part, Plane};

/// A tree of cuts. Leaves are numbered in the order in which they stand in `Search::leaves`.
#[derive(Clone, Copy, Debug)]
pub(super) enum Node {
    Leaf(usize),
    /// Below, above: places in the list of nodes.
    Cut(Plane, [usize; 2]),
}

/// A leaf's hull as the search sees it.
#[derive(Clone)]
pub(super) struct Block {
    pub hull: Grower,
    pub cost: f64,
}

struct Leaf {
    part: Part,
    block: Block,
    cut: Option<Cut>,
    node: usize,
}

impl Leaf {
    fn new(part: Part, places: &Places, node: usize) -> Self {
        let (hull, cut) = best_cut(&part, places);
        let block = Block {
            cost: cost(&hull.hull),
            hull,
        };
        Leaf {
            part,
            block,
            cut,
            node,
        }
    }
}

/// Nodes (the first is the root) and leaves; the area of the whole hull.
pub(super) struct Search {
    pub area: f64,
    pub nodes: Vec<Node>,
    pub leaves: Vec<Block>,
}

/// Cuts the part into at most `most` blocks; stops early where no cut promises to save `fat` times the
/// area of the part's hull.
pub(super) fn search(part: Part, places: &Places, most: usize, fat: f64) -> Search {
    let mut nodes = vec![Node::Leaf(0)];
    let mut leaves = vec![Leaf::new(part, places, 0)];
    let area = leaves[0].block.hull.hull.area();
    while leaves.len() < most {
        let worth = |l: &Leaf| {
            l.cut.as_ref().map_or(f64::NEG_INFINITY, |c| {
                c.gain.max(0.0) + POTENTIAL * l.block.cost
            })
        };
        let Some((k, _)) = leaves
            .iter()
            .enumerate()
            .map(|(k, l)| (k, worth(l)))
            .reduce(|a, b| if b.1 > a.1 { b } else { a })
            .filter(|&(_, w)| w > fat * area)
        else {
            break;
        };
        let Some(cut) = leaves[k].cut.take() else {
            break;
        };
        let [below, above] = leaves[k].part.split(&cut.plane, places.eps, places.reach);
        if below.triangles.is_empty() || above.triangles.is_empty() {
            continue;
        }
        let (first, second) = (nodes.len(), nodes.len() + 1);
        nodes[leaves[k].node] = Node::Cut(cut.plane, [first, second]);
        let (below, above) = join(
            || Leaf::new(below, places, first),
            || Leaf::new(above, places, second),
        );
        nodes.push(Node::Leaf(k));
        nodes.push(Node::Leaf(leaves.len()));
        leaves[k] = below;
        leaves.push(above);
    }
    Search {
        area,
        nodes,
        leaves: leaves.into_iter().map(|l| l.block).collect(),
    }
}

/// What a block without a good cut still promises, as a part of its cost: cuts that help only
/// together (a ring's) are found by going on.
const POTENTIAL: f64 = 0.05;
