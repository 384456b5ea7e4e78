//! Cuts along flat faces deep inside a part's hull.
//!
//! No single cut through a box without a lid saves anything: the hull of the rest has the same lid until the last wall
//! is cut off. But each wall's inner face is deep in the hull, and a cut along it puts it onto the hull of its own
//! part. So a part is divided repeatedly along the flat face with the largest integral of depths.

use rayon::prelude::*;

use super::grower::{Grower, Places};
use super::part::{Part, Plane};
use super::tree::{Node, divide};
use super::vector::{centroid, dot, norm, normal};

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

/// A part and its deep faces.
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

/// A tree of cuts with the parts at its leaves.
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
            let Some((k, (plane, _))) = deepest.filter(|(_, face)| face.1 > least) else {
                break;
            };
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
pub(super) fn cut(part: Part, places: &Places, most: usize) -> Option<Cuts> {
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
