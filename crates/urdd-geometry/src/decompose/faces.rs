//! Cuts along flat faces that lie deep in a part's hull.
//!
//! No single cut through a box without a lid saves anything: the hull of what is left is closed by the same lid
//! until the last wall is off. But each wall's inner face lies deep in the hull, and a cut along it puts it onto the
//! hull of its own part. So here a part is divided along the flat face over which the integral of depths is largest,
//! again and again.

use rayon::join;
use rayon::prelude::*;

use super::grower::{Bounds, Grower, Places};
use super::part::{Part, Plane};
use super::search::Node;
use super::vector::{cross, dot, norm, sub};

/// Less deep than so many steps of the hull is what the hull leaves out.
const LEAST: f64 = 1.2;

/// Planes that are weighed in a part, beside those across the axes.
const MOST_PLANES: usize = 16;

/// A face is worth a cut with this part of the integral over the whole surface.
const WORTH: f64 = 0.01;

/// Only where more of the integral than this part is over the deepest faces is all that lies deep flat: as in boxes.
/// Of links with curved walls these have up to eight tenths, and cuts along them first are no better.
const FLAT: f64 = 0.8;

/// Directions of which the deepest face is tried as the first cut: a comb needs fewer cuts after one along its back
/// than after one along a tooth, which is as deep.
const ROOTS: usize = 3;

/// Normals with a cosine above this are of one direction.
const PARALLEL: f64 = 0.99;

/// A part and its deep faces.
#[derive(Clone)]
struct Deep {
    part: Part,
    /// Depths below the part's hull, integrated over its surface.
    integral: f64,
    /// Planes of flat faces, and how much of the integral is over them; most first.
    faces: Vec<(Plane, f64)>,
    node: usize,
}

impl Deep {
    fn new(part: Part, places: &Places) -> Deep {
        let mut hull = Grower::new(Bounds::new(&part.points).extent());
        part.points.iter().for_each(|&p| hull.add(p));
        let mut triangles: Vec<(f64, [[f64; 3]; 3])> = part
            .triangles
            .iter()
            .filter(|t| !Part::is_loose(**t))
            .filter_map(|t| {
                let [a, b, c] = t.map(|i| part.points[i as usize]);
                let middle = [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0);
                let depth = -hull.hull.farthest_face(middle).1;
                let area = norm(cross(sub(b, a), sub(c, a))) / 2.0;
                (depth > LEAST * hull.step).then_some((depth * area, [a, b, c]))
            })
            .collect();
        // Stable, so the first of equal ones stays first.
        triangles.sort_by(|a, b| b.0.total_cmp(&a.0));
        let flats = places.frames.iter().flat_map(|(frame, flats)| {
            let normal = frame[2];
            flats.iter().map(move |&offset| Plane { normal, offset })
        });
        let mut faces: Vec<(Plane, f64)> = flats.map(|plane| (plane, 0.0)).collect();
        let most = faces.len() + MOST_PLANES;
        for (weight, corners) in &triangles {
            let lies = |plane: &Plane| corners.iter().all(|&p| plane.height(p).abs() <= places.eps);
            match faces.iter().position(|(plane, _)| lies(plane)) {
                Some(k) => faces[k].1 += weight,
                None if faces.len() < most => faces.push((plane_of(*corners), *weight)),
                None => {}
            }
        }
        faces.retain(|face| face.1 > 0.0);
        faces.sort_by(|a, b| b.1.total_cmp(&a.1));
        Deep {
            part,
            integral: triangles.iter().map(|t| t.0).sum(),
            faces,
            node: 0,
        }
    }

    fn split(&self, plane: &Plane, places: &Places) -> Option<[Deep; 2]> {
        let [below, above] = self.part.split(plane, places.eps, places.reach);
        if below.triangles.is_empty() || above.triangles.is_empty() {
            return None;
        }
        let (below, above) = join(|| Deep::new(below, places), || Deep::new(above, places));
        Some([below, above])
    }
}

/// Of a triangle with an area.
fn plane_of([a, b, c]: [[f64; 3]; 3]) -> Plane {
    let n = cross(sub(b, a), sub(c, a));
    let length = norm(n);
    let normal = n.map(|x| x / length);
    Plane {
        normal,
        offset: dot(normal, a),
    }
}

/// A tree of cuts and the parts at its leaves.
struct Tree {
    nodes: Vec<Node>,
    parts: Vec<Deep>,
}

impl Tree {
    /// Cuts part `k`; whether the plane left something on either side.
    fn cut(&mut self, k: usize, plane: Plane, places: &Places) -> bool {
        let Some([mut below, mut above]) = self.parts[k].split(&plane, places) else {
            return false;
        };
        (below.node, above.node) = (self.nodes.len(), self.nodes.len() + 1);
        self.nodes[self.parts[k].node] = Node::Cut(plane, [below.node, above.node]);
        self.nodes.push(Node::Leaf(k));
        self.nodes.push(Node::Leaf(self.parts.len()));
        self.parts[k] = below;
        self.parts.push(above);
        true
    }

    /// Cuts along the deepest face anywhere until there are `most` parts, or no face weighs more than `least`.
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

/// A tree of cuts.
pub(super) struct Cuts {
    /// The first is the root.
    pub nodes: Vec<Node>,
    /// The leaves, and their places among the nodes.
    pub parts: Vec<(Part, usize)>,
}

/// Cuts along deep faces into at most `most` parts. None where what lies deep is not flat.
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
            let mut tree = Tree {
                nodes: vec![Node::Leaf(0)],
                parts: vec![whole.clone()],
            };
            let good = tree.cut(0, plane, places);
            tree.grow(most, WORTH * all, places);
            good.then_some(tree)
        })
        .collect();
    // What is left deep, and a little for each part.
    let rank = |tree: &Tree| tree.integral() + WORTH * all * tree.parts.len() as f64;
    let best = trees
        .into_iter()
        .reduce(|a, b| if rank(&b) < rank(&a) { b } else { a })?;
    let parts = best.parts.into_iter().map(|deep| (deep.part, deep.node));
    Some(Cuts {
        nodes: best.nodes,
        parts: parts.collect(),
    })
}
