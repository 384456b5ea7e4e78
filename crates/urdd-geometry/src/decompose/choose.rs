//! The vertices of the pieces, and which pieces are kept.
//!
//! [`choose`] selects few points whose hull contains all given points, within a tolerance. The extreme points in fixed
//! directions start a hull. Then the point farthest outside is added until none is farther than the tolerance: quickhull's
//! order (Barber, Dobkin and Huhdanpaa, "The quickhull algorithm for convex hulls", 1996), stopped early. The distance is
//! measured to a triangle of chosen points. It is an upper bound of the distance to their hull, so rounding in the growing
//! hull cannot violate the tolerance.
//!
//! [`without_held`] removes redundant flat and thin pieces. Triangles in a cut go to one side of it. If their group has
//! nothing else of that side, the piece of the other side may already contain them. A cut near a corner may also leave a
//! group with a splinter of one triangle only, thinner than what binary32 holds: its piece would have no face with an
//! area. It joins the piece beside it, or is widened where there is none.

use super::growing_hull::GrowingHull;
use super::part::{cross, distance_to_triangle, dot, norm, normal, sub};
use super::slices::{Candidate, support};
use crate::Mesh;
use crate::hull::ConvexHull;
use crate::surface::{self, extent};

/// Maximum number of point-face tests. Links need some tens of millions. If the tolerance requires many thousand faces
/// for many points, the result is all points.
const MAX_TESTS: usize = 2_000_000_000;

/// A subset of the points such that none is farther than `tolerance` from its hull. Returns all points if they are
/// flat.
pub(super) fn choose(points: &[[f64; 3]], tolerance: f64) -> Vec<[f64; 3]> {
    let Some((mut hull, mut corners, eps)) = start(points) else { return points.to_vec() };
    let mut tests = points.len().saturating_mul(hull.slots());
    if tests > MAX_TESTS {
        return points.to_vec();
    }
    let mut outside: Vec<Outside> =
        points.iter().filter_map(|&p| measure(&hull, &corners, p, eps, tolerance)).collect();
    while let Some(k) = farthest(&outside) {
        let p = outside.swap_remove(k).point;
        if !hull.insert(p, eps) {
            // The hull is full, or rounding interferes: return all points.
            return points.to_vec();
        }
        corners.push(p);
        let mut removed = vec![false; hull.slots()];
        hull.removed().iter().for_each(|&f| removed[f as usize] = true);
        tests = tests.saturating_add(outside.len());
        outside.retain_mut(|o| {
            if !removed[o.face as usize] {
                return true;
            }
            tests = tests.saturating_add(removed.len());
            match measure(&hull, &corners, o.point, eps, tolerance) {
                Some(again) => {
                    *o = again;
                    true
                }
                None => false,
            }
        });
        if tests > MAX_TESTS {
            return points.to_vec();
        }
    }
    hull.used().into_iter().map(|i| corners[i]).collect()
}

struct Outside {
    point: [f64; 3],
    face: u32,
    distance: f64,
}

/// Measures a point that is too far outside, at the face that it is farthest above; `None` otherwise.
fn measure(
    hull: &GrowingHull,
    corners: &[[f64; 3]],
    p: [f64; 3],
    eps: f64,
    tolerance: f64,
) -> Option<Outside> {
    let (face, height) = hull.farthest_face(p);
    if height <= eps {
        return None;
    }
    // An upper bound of the distance from the hull.
    let distance = distance_to_triangle(p, hull.face(face).map(|i| corners[i as usize]));
    (distance > tolerance).then_some(Outside { point: p, face, distance })
}

/// The index of the farthest point, the first of equals.
fn farthest(outside: &[Outside]) -> Option<usize> {
    let farther = |a: (usize, f64), b: (usize, f64)| if b.1 > a.1 { b } else { a };
    let distances = outside.iter().map(|o| o.distance).enumerate();
    Some(distances.reduce(farther)?.0)
}

/// The hull of the support points, the points that it took, and a length that is negligible at their size. `None` if
/// the points are flat.
fn start(points: &[[f64; 3]]) -> Option<(GrowingHull, Vec<[f64; 3]>, f64)> {
    let origin = *points.first()?;
    let size = points.iter().map(|p| norm(sub(*p, origin))).fold(0.0, f64::max);
    let scaled = points.iter().map(|&p| sub(p, origin).map(|x| x / size));
    let candidates: Vec<Candidate> = scaled.zip(0..).map(|(p, i)| Candidate::new(p, i)).collect();
    let support: Vec<[f64; 3]> =
        support(&candidates).iter().filter_map(|&i| points.get(i as usize).copied()).collect();
    // A large tetrahedron: the first support point, then the farthest from it, from the line, and from the plane.
    let a = *support.first()?;
    let by = |f: &dyn Fn([f64; 3]) -> f64| {
        support.iter().copied().reduce(|m, p| if f(p) > f(m) { p } else { m })
    };
    let b = by(&|p| norm(sub(p, a)))?;
    let c = by(&|p| norm(cross(sub(b, a), sub(p, a))))?;
    let normal = normal([a, b, c]);
    let d = by(&|p| dot(normal, sub(p, a)).abs())?;
    let (eps, jitter) = (1e-7 * size, 2e-8 * size);
    let mut hull = GrowingHull::tetrahedron([a, b, c, d], 1e-5 * size, jitter)?;
    let mut corners = vec![a, b, c, d];
    for p in support {
        if hull.insert(p, eps) {
            corners.push(p);
        }
    }
    Some((hull, corners, eps))
}

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
    let Some(&p) = points.first() else { return splinter };
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
        let [_, widened] = &splintered(1e-3)[..] else {
            panic!("too far away");
        };
        let rounded = widened.vertices.iter().map(|v| v.map(|x| f64::from(x as f32)));
        let rounded = Mesh { vertices: rounded.collect(), triangles: widened.triangles.clone() };
        assert!(!is_thin(&rounded), "{rounded:?}");
        let x = rounded.vertices.iter().map(|v| v[0]);
        assert!((x.clone().fold(f64::MAX, f64::min) - 5.04).abs() < 1e-4);
        assert!((x.fold(f64::MIN, f64::max) - 5.041).abs() < 1e-4);
    }
}
