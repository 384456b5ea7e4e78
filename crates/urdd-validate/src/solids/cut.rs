//! Faces that are not convex, cut as a mesh cuts them (SPEC 7.8).

use std::collections::{BTreeMap, HashMap, HashSet};

use nalgebra::Vector3;

use super::expected::Expected;
use crate::tolerance::placing_resolution;
use urdd_geometry::Mesh;
use urdd_geometry::surface::{self, Matching, needs_counterpart};

/// Maximum number of triangles and pairs of edges that are looked at, for all faces of a link.
const MAX_WORK: usize = 500_000_000;
/// Maximum number of edges of a face beside which no triangle is, so that trying them takes bounded time.
const MAX_LEFT: usize = 1000;
/// A triangle may face against its face's normal by this sine: rounding of collinear corners.
const TURNED: f64 = 1e-6;

/// The expected mesh of a link, given with uncut faces, with each face cut as `found` cuts it. `None` if it has no
/// uncut face, or `found` does not cut one of them.
pub fn as_found(mut expected: Expected, found: &Mesh) -> Option<Expected> {
    let (whole, faces) = faces(&expected.mesh)?;
    let tolerance = placing_resolution(expected.extent.max(surface::extent(found)));
    let matching = Matching::new(&expected.mesh, found, tolerance);
    let [ours, theirs] = &matching.places;
    let point = |vertex: u32| ours[vertex as usize];
    let known: HashSet<[u32; 3]> = whole.iter().map(|t| from_least(t.map(point))).collect();
    let mut at_point: HashMap<u32, Vec<usize>> = HashMap::new();
    for (at, triangle) in found.triangles.iter().enumerate() {
        at_point.entry(theirs[triangle[0] as usize]).or_default().push(at);
    }
    let mut work = 0;
    let mut cut = Vec::new();
    for fan in faces {
        let places: BTreeMap<u32, Vector3<f64>> = (fan.iter().flatten())
            .map(|vertex| (point(*vertex), expected.mesh.vertices[*vertex as usize].into()))
            .collect();
        let normal: Vector3<f64> =
            (fan.iter()).map(|triangle| area(expected.mesh.corners(*triangle))).sum();
        let own = |triangle: [u32; 3]| triangle.map(|vertex| theirs[vertex as usize]);
        let near = || (places.keys()).flat_map(|point| at_point.get(point).into_iter().flatten());
        work += near().count();
        if work > MAX_WORK {
            return None;
        }
        let candidates: Vec<([u32; 3], [u32; 3])> = near()
            .map(|at| (found.triangles[*at], own(found.triangles[*at])))
            .filter(|(_, points)| points.iter().all(|point| places.contains_key(point)))
            .collect();
        let boundary = boundary(&fan, point);
        let used = fill(
            &boundary,
            &places,
            tolerance,
            &|points| {
                let corners = points.map(|point| places[&point].into());
                let face = area(corners);
                face.dot(&normal) >= -TURNED * face.norm() * normal.norm()
                    && !known.contains(&from_least(points))
            },
            &candidates,
        );
        match used {
            Some(used) => cut.extend(used),
            None => {
                work += boundary.len() * boundary.len();
                if work > MAX_WORK || !crosses_itself(&boundary, &places, normal) {
                    return None;
                }
                cut.extend(candidates.iter().map(|(triangle, _)| *triangle));
            }
        }
    }
    let cut = Mesh { vertices: found.vertices.clone(), triangles: cut };
    expected.mesh.triangles = whole;
    expected.mesh.append(&cut);
    Some(expected)
}

/// The triangles outside of uncut faces, and the fan of each uncut face; `None` without any.
fn faces(mesh: &Mesh) -> Option<(Triangles, Vec<Triangles>)> {
    let mut parts = (mesh.triangles).split(|[a, b, c]| a == b && b == c);
    let mut whole = parts.next()?.to_vec();
    let mut faces = Vec::new();
    while let Some(fan) = parts.next() {
        faces.push(fan.to_vec());
        whole.extend(parts.next()?);
    }
    (!faces.is_empty()).then_some((whole, faces))
}

/// A triangle's corners from the least one on, in the same direction.
fn from_least([a, b, c]: [u32; 3]) -> [u32; 3] {
    [[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap_or([a, b, c])
}

fn area(corners: [[f64; 3]; 3]) -> Vector3<f64> {
    let [a, b, c] = corners.map(Vector3::from);
    (b - a).cross(&(c - a))
}

type Triangles = Vec<[u32; 3]>;

type Edges = BTreeMap<(u32, u32), u32>;

/// Adds a directed edge, or removes its opposite.
fn add(edges: &mut Edges, from: u32, to: u32) {
    if from == to {
        return;
    }
    match edges.get_mut(&(to, from)) {
        Some(1) => {
            edges.remove(&(to, from));
        }
        Some(count) => *count -= 1,
        None => *edges.entry((from, to)).or_default() += 1,
    }
}

/// The directed edges of a face.
fn boundary(fan: &[[u32; 3]], point: impl Fn(u32) -> u32) -> Edges {
    let mut edges = Edges::new();
    for [a, b, c] in fan.iter().map(|triangle| triangle.map(&point)) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            add(&mut edges, from, to);
        }
    }
    edges
}

/// The candidates that fill a boundary. Each faces as the face does, and each inner edge is used once in each
/// direction, so they do not overlap.
fn fill(
    boundary: &Edges,
    places: &BTreeMap<u32, Vector3<f64>>,
    tolerance: f64,
    faces_along: &dyn Fn([u32; 3]) -> bool,
    candidates: &[([u32; 3], [u32; 3])],
) -> Option<Vec<[u32; 3]>> {
    let mut on_edge: HashMap<(u32, u32), Vec<usize>> = HashMap::new();
    for (at, (_, [a, b, c])) in candidates.iter().enumerate() {
        if faces_along([*a, *b, *c]) {
            for edge in [(*a, *b), (*b, *c), (*c, *a)] {
                on_edge.entry(edge).or_default().push(at);
            }
        }
    }
    let mut left = boundary.clone();
    let mut used = Vec::new();
    let mut open: Vec<(u32, u32)> = left.keys().copied().collect();
    while let Some(edge) = open.pop() {
        let on = on_edge.get_mut(&edge).filter(|_| left.contains_key(&edge));
        let Some(at) = on.and_then(Vec::pop) else { continue };
        let (triangle, [a, b, c]) = candidates[at];
        used.push(triangle);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            add(&mut left, to, from);
            open.push((to, from));
        }
    }
    if left.len() > MAX_LEFT {
        return None;
    }
    // Collinear corners may be left out: their triangles need not be there.
    let place = |point: u32| places[&point].into();
    while let Some((&(a, b), _)) = left.iter().next() {
        let spare = |(from, c): &&(u32, u32)| {
            *from == b && !needs_counterpart([place(a), place(b), place(*c)], tolerance)
        };
        let (_, c) = *left.keys().find(spare)?;
        add(&mut left, b, a);
        add(&mut left, c, b);
        add(&mut left, a, c);
    }
    Some(used)
}

/// Whether two edges of a face cross, seen along its normal.
fn crosses_itself(
    boundary: &Edges,
    places: &BTreeMap<u32, Vector3<f64>>,
    normal: Vector3<f64>,
) -> bool {
    let axis = normal.iamax();
    let flat = |point: u32| {
        let place = places[&point];
        [place[(axis + 1) % 3], place[(axis + 2) % 3]]
    };
    let side = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let edges: Vec<(u32, u32)> = boundary.keys().copied().collect();
    edges.iter().enumerate().any(|(at, &(a, b))| {
        let (p, q) = (flat(a), flat(b));
        edges[at + 1..].iter().any(|&(c, d)| {
            let (r, s) = (flat(c), flat(d));
            side(p, q, r) * side(p, q, s) < 0.0 && side(r, s, p) * side(r, s, q) < 0.0
        })
    })
}
