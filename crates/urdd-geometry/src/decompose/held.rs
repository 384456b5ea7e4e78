//! Removal of redundant flat pieces. Triangles in a cut go to one side of it. If their group has nothing else of that
//! side, the piece of the other side may already contain them.

use super::vector::{cross, dot, norm, sub};
use crate::Mesh;
use crate::hull::ConvexHull;

/// The pieces, without flat ones that another piece contains within `tolerance`.
pub(super) fn without_held(pieces: Vec<ConvexHull>, tolerance: f64) -> Vec<Mesh> {
    let is_held = |flat: &ConvexHull| {
        let mut bodies = pieces.iter().filter(|other| !other.is_flat());
        flat.is_flat() && bodies.any(|body| lies_in(flat.mesh(), body.mesh(), tolerance))
    };
    let kept: Vec<bool> = pieces.iter().map(|piece| !is_held(piece)).collect();
    let kept = pieces.into_iter().zip(kept).filter(|(_, kept)| *kept);
    kept.map(|(piece, _)| piece.into_mesh()).collect()
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
        without_held(vec![hull(&square), hull(&cube)], 2e-6).len()
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
        assert_eq!(without_held(both, 2e-6).len(), 2, "flat bodies alone");
    }
}
