//! Selects few points whose hull contains all given points, within a tolerance.
//!
//! The extreme points in fixed directions start a hull. Then the point farthest outside is added until none is farther
//! than the tolerance: quickhull's order (Barber, Dobkin and Huhdanpaa, "The quickhull algorithm for convex hulls",
//! 1996), stopped early. The distance is measured to a triangle of chosen points. It is an upper bound of the distance
//! to their hull, so rounding in the growing hull cannot violate the tolerance.

use super::growing_hull::GrowingHull;
use super::support::{Candidate, support};
use super::vector::{cross, distance_to_triangle, dot, norm, normal, sub};

/// Maximum number of point-face tests. Links need some tens of millions. If the tolerance requires many thousand faces
/// for many points, the result is all points.
const MAX_TESTS: usize = 2_000_000_000;

/// A subset of the points such that none is farther than `tolerance` from its hull. Returns all points if they are
/// flat.
pub(super) fn choose(points: &[[f64; 3]], tolerance: f64) -> Vec<[f64; 3]> {
    let Some((mut hull, mut corners, eps)) = start(points) else {
        return points.to_vec();
    };
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
