//! The best cutting plane of a part, and cuts along flat faces deep inside its hull.
//!
//! A part's *cost* is the standoff of its hull (`field`) plus a fraction of the hull's bulk: V + t A / 2 for a small
//! thickness t, so that flat parts have a cost too. Planes are tried at many offsets along a few directions; the one
//! that lowers the summed cost of the two sides most is taken. Two sweeps evaluate all planes of a direction: the part
//! is sliced once, and a hull that grows slice by slice gives the cost of everything below each plane. The reverse
//! sweep gives the cost of everything above.
//!
//! No single cut through a box without a lid saves anything: the hull of the rest has the same lid until the last wall
//! is cut off. But each wall's inner face is deep in the hull, and a cut along it puts it onto the hull of its own
//! part. So [`along_faces`] divides a part repeatedly along the flat face with the largest integral of depths.

use rayon::prelude::*;

use super::part::{Bounds, Node, Part, Plane, centroid, divide, dot, norm, normal};
use super::slices::{Frame, Grower, Places, SEED, Slices};

/// Evenly spaced planes per axis; flat coordinates come on top.
const EVEN: usize = 9;

/// Evenly spaced planes per diagonal.
const EVEN_DIAGONAL: usize = 5;

/// Weight of a cut through the middle of the longest extent, as a fraction of the part's cost. It decides when no
/// single cut helps, as in a ring, where only the second one does.
const MIDDLE: f64 = 0.01;

/// A cut and the cost that it saves.
#[derive(Clone, Debug)]
pub(super) struct Cut {
    pub plane: Plane,
    pub gain: f64,
    pub score: f64,
}

/// The part's hull, and its cuts along the first direction; `None` if it is convex.
pub(super) fn first_cuts(part: &Part, places: &Places) -> (Grower, Option<Vec<Cut>>) {
    match places.frames.first().and_then(|along| cuts_along(part, along, places)) {
        Some((whole, _)) if is_convex(part, &whole) => (whole, None),
        Some((whole, cuts)) => (whole, Some(cuts)),
        None => (Grower::of(&part.points), Some(Vec::new())),
    }
}

/// The cuts of a part along all directions, best first. `first` are those along the first direction.
pub(super) fn best_cuts(part: &Part, first: &[Cut], places: &Places) -> Vec<Cut> {
    let frames = places.frames.get(1..).unwrap_or_default().par_iter();
    let others: Vec<Vec<Cut>> =
        frames.filter_map(|along| Some(cuts_along(part, along, places)?.1)).collect();
    let mut found = [first, &others.concat()].concat();
    // A stable sort keeps the first of equals first.
    found.sort_by(|a, b| b.score.total_cmp(&a.score));
    found
}

/// Whether no triangle of the surface is deeper in the hull than the search resolves.
fn is_convex(part: &Part, whole: &Grower) -> bool {
    part.triangles.iter().all(|t| {
        let depth = || whole.hull.farthest_face(centroid(part.corners(*t))).1;
        Part::is_loose(*t) || depth() > -1.2 * whole.step
    })
}

/// The frames of the cutting directions, with the flat coordinates to try along each in addition to the even ones. The
/// directions are the axes (z first), which have the given flats, and the diagonals between any two axes.
pub(super) fn frames(flats: [Vec<f64>; 3]) -> Vec<Frame> {
    let axis = |a: usize| [0, 1, 2].map(|b| f64::from(u8::from(a % 3 == b)));
    let mut out: Vec<Frame> = Vec::new();
    let [x, y, z] = flats;
    for (a, flats) in [(2, z), (0, x), (1, y)] {
        out.push(([axis(a + 1), axis(a + 2), axis(a)], flats));
    }
    let half = 0.5_f64.sqrt();
    for a in 0..3 {
        for sign in [half, -half] {
            let (x, y) = (axis(a), axis(a + 1));
            let along = [0, 1, 2].map(|k| half * x[k] + sign * y[k]);
            let beside = [0, 1, 2].map(|k| half * x[k] - sign * y[k]);
            out.push(([beside, axis(a + 2), along], Vec::new()));
        }
    }
    out
}

/// Offsets of the planes between `low` and `high`, ascending: `even` evenly spaced ones, and flats.
fn offsets(low: f64, high: f64, flats: &[f64], eps: f64, even: usize) -> Vec<f64> {
    let step = (high - low) / (even + 1) as f64;
    let near = (0.02 * (high - low)).max(2.0 * eps);
    let mut out: Vec<f64> =
        flats.iter().copied().filter(|x| *x > low + near && *x < high - near).collect();
    out.dedup_by(|b, a| *b - *a < 2.0 * eps);
    out.truncate(MAX_OFFSETS - EVEN);
    let flat = out.len();
    for k in 1..=even {
        let x = low + step * k as f64;
        if out[..flat].iter().all(|f| (f - x).abs() > 0.3 * step) {
            out.push(x);
        }
    }
    out.sort_by(f64::total_cmp);
    out
}

/// The limit of a slice mask, which has one bit per slice.
const MAX_OFFSETS: usize = 31;

/// The part's hull (in the coordinates of the frame) and its cuts along the frame's z: those with a locally maximal
/// score. `None` if the part is too thin to be sliced.
fn cuts_along(part: &Part, (frame, flats): &Frame, places: &Places) -> Option<(Grower, Vec<Cut>)> {
    let (eps, normal) = (places.eps, frame[2]);
    // Coordinates in the frame: the planes are perpendicular to their z.
    let turned: Vec<[f64; 3]> =
        part.points.iter().map(|&p| frame.map(|axis| dot(axis, p))).collect();
    let bounds = Bounds::of(turned.iter().copied());
    let (low, high) = (bounds.min[2], bounds.max[2]);
    if high - low <= (8.0 * eps).max(10.0 * SEED) {
        return None;
    }
    let even = if normal.contains(&1.0) { EVEN } else { EVEN_DIAGONAL };
    let planes = offsets(low, high, flats, eps, even);
    let slices = Slices::new(part, &turned, frame, &planes, places);
    let cost = |hull: &mut Grower, k: usize| {
        let mut cuts = part.cuts.clone();
        cuts.push(Plane { normal, offset: planes[k] });
        places.cost(hull, frame, &cuts)
    };
    let (below, mut whole) = slices.sweep(true, bounds.extent(), cost);
    let (above, _) = slices.sweep(false, bounds.extent(), cost);
    let all = places.cost(&mut whole, frame, &part.cuts);
    let scored: Vec<Option<Cut>> = (0..planes.len())
        .map(|k| {
            let (offset, b, a) = (planes[k], below[k], above[planes.len() - 1 - k]);
            // Zero means that the side is empty.
            (b > 0.0 && a > 0.0).then(|| {
                let gain = all - b - a;
                let middle = 1.0 - (2.0 * (offset - low) / (high - low) - 1.0).abs();
                let score = gain + MIDDLE * all * middle * (high - low) / bounds.extent();
                Cut { plane: Plane { normal, offset }, gain, score }
            })
        })
        .collect();
    let score = |k: usize| {
        let cut = scored.get(k).and_then(Option::as_ref);
        cut.map_or(f64::NEG_INFINITY, |c| c.score)
    };
    let peaks = (0..planes.len())
        .filter(|&k| score(k) > score(k.wrapping_sub(1)) && score(k) >= score(k + 1))
        .filter_map(|k| scored[k].clone());
    Some((whole, peaks.collect()))
}

/// Depths below this many steps of the hull are within the hull's error.
const LEAST: f64 = 1.2;

/// Maximum number of planes considered in a part, in addition to the axis-aligned ones.
const MAX_PLANES: usize = 16;

/// Minimum share of a face in the integral over the whole surface for a cut.
const WORTH: f64 = 0.01;

/// If the faces have more than this share of the integral, everything deep counts as flat, as in boxes. On links with
/// curved walls the share is up to 0.8, and cuts along faces first are no better.
const FLAT: f64 = 0.8;

/// Number of directions whose deepest face is tried as the first cut. A comb needs fewer cuts after one along its back
/// than after one along a tooth, which is as deep.
const ROOTS: usize = 3;

/// Normals with a cosine above this count as parallel.
const PARALLEL: f64 = 0.99;

#[derive(Clone)]
struct Deep {
    part: Part,
    /// Integral of the depths below the part's hull over its surface.
    integral: f64,
    /// Planes of flat faces with their shares of the integral, largest first.
    faces: Vec<(Plane, f64)>,
    node: usize,
}

impl Deep {
    fn new(part: Part, places: &Places) -> Deep {
        let hull = Grower::of(&part.points);
        let mut triangles: Vec<(f64, [[f64; 3]; 3])> = part
            .triangles
            .iter()
            .filter(|t| !Part::is_loose(**t))
            .filter_map(|t| {
                let corners = part.corners(*t);
                let depth = -hull.hull.farthest_face(centroid(corners)).1;
                let area = norm(normal(corners)) / 2.0;
                (depth > LEAST * hull.step).then_some((depth * area, corners))
            })
            .collect();
        // A stable sort keeps the first of equals first.
        triangles.sort_by(|a, b| b.0.total_cmp(&a.0));
        let flats = places.frames.iter().flat_map(|(frame, flats)| {
            let normal = frame[2];
            flats.iter().map(move |&offset| Plane { normal, offset })
        });
        let mut faces: Vec<(Plane, f64)> = flats.map(|plane| (plane, 0.0)).collect();
        let most = faces.len() + MAX_PLANES;
        for (weight, corners) in &triangles {
            let lies = |plane: &Plane| corners.iter().all(|&p| plane.height(p).abs() <= places.eps);
            match faces.iter().position(|(plane, _)| lies(plane)) {
                Some(k) => faces[k].1 += weight,
                None if faces.len() < most => faces.push((Plane::of(*corners), *weight)),
                None => {}
            }
        }
        faces.retain(|face| face.1 > 0.0);
        faces.sort_by(|a, b| b.1.total_cmp(&a.1));
        Deep { part, integral: triangles.iter().map(|t| t.0).sum(), faces, node: 0 }
    }
}

struct Tree {
    nodes: Vec<Node>,
    parts: Vec<Deep>,
}

impl Tree {
    /// Cuts part `k`; false, without a cut, if a side would be empty.
    fn cut(&mut self, k: usize, plane: Plane, places: &Places) -> bool {
        let part = &self.parts[k].part;
        let Some([mut below, mut above]) =
            places.split(part, &plane, |part| Deep::new(part, places))
        else {
            return false;
        };
        let leaves = [k, self.parts.len()];
        [below.node, above.node] = divide(&mut self.nodes, self.parts[k].node, plane, leaves);
        self.parts[k] = below;
        self.parts.push(above);
        true
    }

    /// Cuts along the deepest face of all parts until there are `most` parts, or no face weighs more than `least`.
    fn grow(&mut self, most: usize, least: f64, places: &Places) {
        while self.parts.len() < most {
            let parts = self.parts.iter().enumerate();
            let deepest = parts
                .filter_map(|(k, deep)| Some((k, *deep.faces.first()?)))
                .reduce(|a, b| if b.1.1 > a.1.1 { b } else { a });
            let Some((k, (plane, _))) = deepest.filter(|(_, face)| face.1 > least) else { break };
            if !self.cut(k, plane, places) {
                self.parts[k].faces.remove(0);
            }
        }
    }

    fn integral(&self) -> f64 {
        self.parts.iter().map(|deep| deep.integral).sum()
    }
}

/// The nodes of a tree of cuts, and the parts at its leaves with their indices among the nodes.
pub(super) type Cuts = (Vec<Node>, Vec<(Part, usize)>);

/// Cuts along deep faces into at most `most` parts. `None` unless everything deep is flat.
pub(super) fn along_faces(part: Part, places: &Places, most: usize) -> Option<Cuts> {
    let whole = Deep::new(part, places);
    let all = whole.integral;
    let flat: f64 = whole.faces.iter().map(|face| face.1).sum();
    if flat <= FLAT * all || most < 2 {
        return None;
    }
    let mut roots: Vec<Plane> = Vec::new();
    for (plane, _) in &whole.faces {
        let parallel = |root: &Plane| dot(root.normal, plane.normal).abs() > PARALLEL;
        if roots.len() < ROOTS && !roots.iter().any(parallel) {
            roots.push(*plane);
        }
    }
    let trees: Vec<Tree> = roots
        .into_par_iter()
        .filter_map(|plane| {
            let mut tree = Tree { nodes: vec![Node::Leaf(0)], parts: vec![whole.clone()] };
            let good = tree.cut(0, plane, places);
            tree.grow(most, WORTH * all, places);
            good.then_some(tree)
        })
        .collect();
    // The remaining integral, and a small penalty per part.
    let rank = |tree: &Tree| tree.integral() + WORTH * all * tree.parts.len() as f64;
    let best = trees.into_iter().reduce(|a, b| if rank(&b) < rank(&a) { b } else { a })?;
    let parts = best.parts.into_iter().map(|deep| (deep.part, deep.node));
    Some((best.nodes, parts.collect()))
}
