//! Copies of one convex shape at many places: the points of a cloud, the columns of a height field. A tree of boxes finds
//! those near a sphere.

use std::sync::Arc;

use arrayvec::ArrayVec;
use fearless_simd::{Simd, prelude::*};

use crate::lanes::{LANES, Row, Vec3, bits, splat};
use urdd_geometry::convex::ConvexShape;
use urdd_geometry::mesh::Bounds;

/// The copies, and the tree. Copies are boxes in it: around a centre, with half extents that all share.
#[derive(Debug)]
pub(crate) struct Copies {
    /// About its centre, which is the origin.
    pub core: Arc<ConvexShape>,
    /// Of the core, m.
    half: [f64; 3],
    /// Where the tree is: its numbers in 32 bits are relative to it, m.
    pub middle: [f64; 3],
    /// Around all copies, m.
    pub bounds: Bounds,
    /// The centres of the copies in the order of the tree, m.
    pub centres: Vec<[f64; 3]>,
    nodes: Vec<Node>,
    /// The centres again, eight at once.
    leaves: Vec<[Row; 3]>,
}

/// More than eight for each node of a path: a node has at most eight times the leaves of those in it.
const WAITING: usize = 128;

/// Eight boxes, and what is in them.
#[derive(Debug, Clone)]
struct Node {
    least: [Row; 3],
    most: [Row; 3],
    children: [Child; LANES],
}

#[derive(Debug, Clone, Copy)]
enum Child {
    /// Nothing: its box is infinitely far.
    None,
    Node(u32),
    Leaf(u32),
}

impl Copies {
    /// There is at least one centre, and all are finite.
    pub fn new(core: ConvexShape, half: [f64; 3], mut centres: Vec<[f64; 3]>) -> Self {
        let around = Bounds::of(centres.iter().copied());
        let middle = [0, 1, 2].map(|k| 0.5 * (around.min[k] + around.max[k]));
        let bounds = Bounds {
            min: [0, 1, 2].map(|k| around.min[k] - half[k]),
            max: [0, 1, 2].map(|k| around.max[k] + half[k]),
        };
        let mut tree = Tree { half, middle, nodes: Vec::new(), leaves: Vec::new() };
        tree.node(&mut centres);
        let Tree { nodes, leaves, .. } = tree;
        Copies { core: Arc::new(core), half, middle, bounds, centres, nodes, leaves }
    }

    /// The squared distance of a point from a copy, m².
    pub fn apart(&self, copy: usize, point: [f64; 3]) -> f64 {
        let centre = &self.centres[copy];
        let away = |k: usize| ((point[k] - centre[k]).abs() - self.half[k]).max(0.0);
        (0..3).map(|k| away(k) * away(k)).sum()
    }

    /// Calls `each` with copies near a point and the squares of lower bounds of their distances, until none is nearer than
    /// the square that the last call returned. Starts with `within`.
    pub fn near(&self, point: [f64; 3], within: f64, mut each: impl FnMut(usize, f64) -> f64) {
        let local = [0, 1, 2].map(|k| point[k] - self.middle[k]);
        let mut within = within;
        // The nearest box is on top. At most eight wait for each node of a path.
        let mut waiting: ArrayVec<(f64, Child), WAITING> = ArrayVec::new();
        waiting.push((0.0, Child::Node(0)));
        while let Some((bound, child)) = waiting.pop() {
            if bound > within {
                continue;
            }
            match child {
                Child::None => {}
                Child::Leaf(leaf) => {
                    let first = leaf as usize * LANES;
                    for copy in first..(first + LANES).min(self.centres.len()) {
                        let apart = self.apart(copy, point);
                        if apart <= within {
                            within = each(copy, apart);
                        }
                    }
                }
                Child::Node(node) => {
                    let node = &self.nodes[node as usize];
                    let from = waiting.len();
                    for (lane, child) in node.children.iter().enumerate() {
                        let away = |k: usize| {
                            let least = f64::from(node.least[k].0[lane]) - local[k];
                            least.max(local[k] - f64::from(node.most[k].0[lane])).max(0.0)
                        };
                        let bound: f64 = (0..3).map(|k| away(k) * away(k)).sum();
                        if bound <= within {
                            let _ = waiting.try_push((bound, *child));
                        }
                    }
                    waiting[from..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
                }
            }
        }
    }

    /// The nearest copy to a point and the square of their distance, m².
    pub fn nearest(&self, point: [f64; 3]) -> (usize, f64) {
        let mut best = (0, f64::INFINITY);
        self.near(point, f64::INFINITY, |copy, apart| {
            if apart < best.1 {
                best = (copy, apart);
            }
            best.1
        });
        best
    }
}

impl Copies {
    /// Whether any copy is at most `reach` from a point of the frame of the tree.
    #[inline(always)]
    pub fn any_touches<S: Simd>(&self, simd: S, point: [f32; 3], reach: f32) -> bool {
        let at = Vec3::splat(simd, point);
        let (zero, squared) = (splat(simd, 0.0), splat(simd, reach * reach));
        let half = [self.half[0] as f32, self.half[1] as f32, self.half[2] as f32];
        let mut waiting: ArrayVec<Child, WAITING> = ArrayVec::new();
        waiting.push(Child::Node(0));
        while let Some(child) = waiting.pop() {
            match child {
                Child::None => {}
                Child::Leaf(leaf) => {
                    let centre = Vec3::load(simd, &self.leaves[leaf as usize]);
                    let x = ((centre.x - at.x).abs() - half[0]).max(zero);
                    let y = ((centre.y - at.y).abs() - half[1]).max(zero);
                    let z = ((centre.z - at.z).abs() - half[2]).max(zero);
                    if (x * x + y * y + z * z).simd_le(squared).any_true() {
                        return true;
                    }
                }
                Child::Node(node) => {
                    let node = &self.nodes[node as usize];
                    let (least, most) =
                        (Vec3::load(simd, &node.least), Vec3::load(simd, &node.most));
                    let x = (least.x - at.x).max(at.x - most.x).max(zero);
                    let y = (least.y - at.y).max(at.y - most.y).max(zero);
                    let z = (least.z - at.z).max(at.z - most.z).max(zero);
                    let mut near = bits((x * x + y * y + z * z).simd_le(squared));
                    while near != 0 {
                        let lane = near.trailing_zeros() as usize;
                        near &= near - 1;
                        let _ = waiting.try_push(node.children[lane]);
                    }
                }
            }
        }
        false
    }
}

struct Tree {
    half: [f64; 3],
    middle: [f64; 3],
    nodes: Vec<Node>,
    leaves: Vec<[Row; 3]>,
}

impl Tree {
    fn node(&mut self, centres: &mut [[f64; 3]]) -> u32 {
        let index = self.nodes.len();
        let [far, near] = [Row([f32::INFINITY; LANES]), Row([f32::NEG_INFINITY; LANES])];
        let (least, most, children) = ([far; 3], [near; 3], [Child::None; LANES]);
        self.nodes.push(Node { least, most, children });
        // Parts are whole leaves, but for the last one.
        let leaves = centres.len().div_ceil(LANES);
        for (lane, part) in parts(centres, leaves).into_iter().enumerate() {
            let Bounds { min, max } = Bounds::of(part.iter().copied());
            let child = match part.len() <= LANES {
                true => Child::Leaf(self.leaf(part)),
                false => Child::Node(self.node(part)),
            };
            let node = &mut self.nodes[index];
            node.children[lane] = child;
            for k in 0..3 {
                let least = (min[k] - self.half[k] - self.middle[k]) as f32;
                let most = (max[k] + self.half[k] - self.middle[k]) as f32;
                node.least[k].0[lane] = least.next_down();
                node.most[k].0[lane] = most.next_up();
            }
        }
        index as u32
    }

    fn leaf(&mut self, centres: &[[f64; 3]]) -> u32 {
        let last = centres.len() - 1;
        let row = |k: usize| {
            Row(std::array::from_fn(|lane| (centres[lane.min(last)][k] - self.middle[k]) as f32))
        };
        self.leaves.push([row(0), row(1), row(2)]);
        (self.leaves.len() - 1) as u32
    }
}

/// Up to eight parts of centres that are near each other, each of whole leaves.
fn parts(centres: &mut [[f64; 3]], leaves: usize) -> Vec<&mut [[f64; 3]]> {
    let mut parts = vec![(centres, leaves)];
    for _ in 0..LANES.ilog2() {
        let halves = |(part, leaves): (_, usize)| -> Vec<(&mut [[f64; 3]], usize)> {
            let part: &mut [[f64; 3]] = part;
            if leaves <= 1 {
                return vec![(part, leaves)];
            }
            let Bounds { min, max } = Bounds::of(part.iter().copied());
            let longest = |k: &usize| max[*k] - min[*k];
            let axis = (0..3).max_by(|a, b| longest(a).total_cmp(&longest(b))).unwrap_or(0);
            let half = leaves / 2;
            let at = half * LANES;
            let order = |a: &[f64; 3], b: &[f64; 3]| {
                let keys = [axis, (axis + 1) % 3, (axis + 2) % 3].map(|k| a[k].total_cmp(&b[k]));
                keys[0].then(keys[1]).then(keys[2])
            };
            part.select_nth_unstable_by(at, order);
            let (low, high) = part.split_at_mut(at);
            vec![(low, half), (high, leaves - half)]
        };
        parts = parts.into_iter().flat_map(halves).collect();
    }
    parts.into_iter().map(|(part, _)| part).collect()
}
