//! Removal of redundant flat and thin pieces. Triangles in a cut go to one side of it. If their group has nothing else
//! of that side, the piece of the other side may already contain them. A cut near a corner may also leave a group with a
//! splinter of one triangle only, thinner than what binary32 holds: its piece would have no face with an area.

use super::vector::{cross, dot, norm, sub};
use crate::Mesh;
use crate::hull::ConvexHull;

/// A triangle is thin if its smallest height is at most this fraction of the piece's largest coordinate: 16 steps of
/// binary32. Validators may take 8 steps as equal (SPEC 7.6).
const THIN: f64 = 16.0 * 1.1920929e-7;

/// The pieces, without flat ones that another piece contains within `contained`, metres. Thin ones whose distance from
/// another piece is at most `near`, metres, become part of that piece.
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
            None => pieces.push(splinter),
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

/// Whether each triangle of a mesh is thin.
fn is_thin(mesh: &Mesh) -> bool {
    let coordinates = mesh.vertices.iter().flatten();
    let height = THIN * coordinates.fold(0.0, |most: f64, x| most.max(x.abs()));
    mesh.triangles.iter().all(|triangle| {
        let [a, b, c] = triangle.map(|corner| mesh.vertices[corner as usize]);
        let sides = [sub(b, a), sub(c, b), sub(a, c)];
        let longest = sides.map(norm).into_iter().fold(0.0, f64::max);
        // Twice the area is the longest side times the smallest height.
        norm(cross(sides[0], sides[2])) <= height * longest
    })
}

fn lies_in(mesh: &Mesh, body: &Mesh, tolerance: f64) -> bool {
    body.triangles.iter().all(|triangle| {
        let [a, b, c] = triangle.map(|corner| body.vertices[corner as usize]);
        let normal = cross(sub(b, a), sub(c, a));
        let most = tolerance * norm(normal);
        let mut points = mesh.vertices.iter();
        points.all(|p| dot(normal, sub(*p, a)) <= most)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hull(points: &[[f64; 3]]) -> ConvexHull {
        ConvexHull::new(points).expect("a hull")
    }

    /// A cube from 0 to 10 cm, and a 2 cm square at the given height.
    fn count(height: f64, left: f64) -> usize {
        let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { 0.0 } else { 0.1 });
        let cube: Vec<[f64; 3]> = (0..8).map(corner).collect();
        let square = [(0.0, 0.0), (0.02, 0.0), (0.02, 0.02), (0.0, 0.02)];
        let square = square.map(|(x, y)| [left + x, 0.04 + y, height]);
        without_held(vec![hull(&square), hull(&cube)], 2e-6, 2e-4).len()
    }

    #[test]
    fn a_square_in_a_face_goes() {
        assert_eq!(count(0.1, 0.04), 1, "in the lid");
        assert_eq!(count(0.1 + 1e-6, 0.04), 1, "over the lid, by rounding");
        assert_eq!(count(0.05, 0.04), 1, "inside");
    }

    #[test]
    fn what_no_other_piece_holds_stays() {
        assert_eq!(count(0.1 + 1e-5, 0.04), 2, "over the lid");
        assert_eq!(count(0.1, 0.09), 2, "beyond the edge");
        let square = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let both = vec![hull(&square), hull(&square)];
        assert_eq!(without_held(both, 2e-6, 2e-4).len(), 2, "flat bodies alone");
    }

    /// A cube from 0 to 10 cm, 5 m along x, and a splinter over its lid, some 1 mm long and 1e-7 m wide.
    fn splintered(above: f64) -> Vec<Mesh> {
        let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { 0.0 } else { 0.1 });
        let moved = |[x, y, z]: [f64; 3]| [x + 5.0, y, z];
        let cube: Vec<[f64; 3]> = (0..8).map(corner).map(moved).collect();
        let splinter = [(0.04, 0.04), (0.041, 0.04), (0.0405, 0.04 + 1e-7)];
        let splinter = splinter.map(|(x, y)| moved([x, y, 0.1 + above]));
        without_held(vec![hull(&splinter), hull(&cube)], 2e-6, 2e-4)
    }

    #[test]
    fn a_splinter_joins_the_piece_that_it_is_near() {
        let [joined] = &splintered(1e-5)[..] else {
            panic!("one piece");
        };
        let highest = joined.vertices.iter().map(|v| v[2]);
        assert_eq!(highest.fold(0.0, f64::max), 0.1 + 1e-5);
        assert_eq!(splintered(1e-3).len(), 2, "too far away");
    }
}
