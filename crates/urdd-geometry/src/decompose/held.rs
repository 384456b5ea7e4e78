//! Removal of redundant flat and thin pieces. Triangles in a cut go to one side of it. If their group has nothing else
//! of that side, the piece of the other side may already contain them. A cut near a corner may also leave a group with a
//! splinter of one triangle only, thinner than what binary32 holds: its piece would have no face with an area. It joins
//! the piece beside it, or is widened where there is none.

use super::vector::{cross, dot, norm, normal, sub};
use crate::Mesh;
use crate::hull::ConvexHull;
use crate::surface::{self, extent};

/// A triangle is thin if its smallest height is at most this fraction of the piece's largest coordinate: 16 steps of
/// binary32. Validators may take 8 steps as equal (SPEC 7.6).
const THIN: f64 = 16.0 * 1.1920929e-7;

/// How wide a splinter becomes, as a fraction of the same.
const WIDE: f64 = 4.0 * THIN;

/// The pieces, without flat ones that another piece contains within `contained`, metres. Thin ones whose distance from
/// another piece is at most `near`, metres, become part of that piece; others become flat triangles.
pub(super) fn without_held(pieces: Vec<ConvexHull>, contained: f64, near: f64) -> Vec<Mesh> {
    let (splinters, mut pieces): (Vec<_>, Vec<_>) =
        pieces.into_iter().partition(|piece| is_thin(piece.mesh()));
    for splinter in splinters {
        let host = pieces.iter_mut().find_map(|piece| {
            let is_near = !piece.is_flat() && lies_in(splinter.mesh(), piece.mesh(), near);
            let points = [&piece.mesh().vertices[..], &splinter.mesh().vertices].concat();
            let grown = is_near.then(|| ConvexHull::new(&points).ok()).flatten()?;
            Some((piece, grown))
        });
        match host {
            Some((piece, grown)) => *piece = grown,
            None => pieces.push(widened(splinter)),
        }
    }
    let is_held = |flat: &ConvexHull| {
        let mut bodies = pieces.iter().filter(|other| !other.is_flat());
        flat.is_flat() && bodies.any(|body| lies_in(flat.mesh(), body.mesh(), contained))
    };
    let kept: Vec<bool> = pieces.iter().map(|piece| !is_held(piece)).collect();
    let kept = pieces.into_iter().zip(kept).filter(|(_, kept)| *kept);
    kept.map(|(piece, _)| piece.into_mesh()).collect()
}

/// A flat triangle along a splinter, just wide enough to have an area in binary32.
fn widened(splinter: ConvexHull) -> ConvexHull {
    let points = &splinter.mesh().vertices;
    let Some(&p) = points.first() else {
        return splinter;
    };
    let far = |from: [f64; 3]| {
        let length = |q: &&[f64; 3]| norm(sub(**q, from));
        points.iter().max_by(|a, b| length(a).total_cmp(&length(b))).map_or(from, |q| *q)
    };
    let p = far(p);
    let q = far(p);
    let along = sub(q, p);
    let along = along.map(|x| x / norm(along));
    // Across it: at a right angle to the axis that it is least along.
    let least = (0..3).min_by(|a, b| along[*a].abs().total_cmp(&along[*b].abs()));
    let axis = [0, 1, 2].map(|k| if Some(k) == least { 1.0 } else { 0.0 });
    let across = cross(along, axis);
    let across = across.map(|x| x / norm(across));
    let width = WIDE * extent(splinter.mesh());
    let corner = |base: [f64; 3], a: f64, b: f64| {
        [0, 1, 2].map(|k| base[k] + width * (a * along[k] + b * across[k]))
    };
    let middle = [0, 1, 2].map(|k| 0.5 * (p[k] + q[k]));
    let corners = [corner(p, -1.0, 0.0), corner(q, 1.0, 0.0), corner(middle, 0.0, 1.0)];
    ConvexHull::new(&corners).unwrap_or(splinter)
}

/// Whether each triangle of a mesh is thin.
pub(super) fn is_thin(mesh: &Mesh) -> bool {
    let height = THIN * extent(mesh);
    mesh.triangles.iter().all(|triangle| surface::is_thin(mesh.corners(*triangle), height))
}

fn lies_in(mesh: &Mesh, body: &Mesh, tolerance: f64) -> bool {
    body.triangles.iter().all(|triangle| {
        let corners = body.corners(*triangle);
        let normal = normal(corners);
        let most = tolerance * norm(normal);
        mesh.vertices.iter().all(|p| dot(normal, sub(*p, corners[0])) <= most)
    })
}

#[cfg(test)]
#[path = "tests/held.rs"]
mod tests;
