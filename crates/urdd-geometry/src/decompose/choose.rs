//! Few points whose hull holds all of many, to within a tolerance.
//!
//! The points farthest out in fixed directions start a hull; then the point farthest outside is
//! added, until none is farther than the tolerance: quickhull's order (Barber, Dobkin and Huhdanpaa,
//! "The quickhull algorithm for convex hulls", 1996), stopped early. The distance that counts is that
//! from a triangle of chosen points, which is never less than the distance from their hull: so the
//! promise does not rest on the growing hull being free of rounding.

use super::growing_hull::GrowingHull;
use super::support::{Candidate, support};
use super::vector::{cross, distance_to_triangle, dot, norm, sub};

/// So often a point may be held against a face. Links need some tens of millions; where the tolerance asks for
/// many thousand faces about many points, all corners of their hull are taken instead.
const MOST_LOOKS: usize = 2_000_000_000;

/// A subset of the points, none of them farther than `tolerance` from its hull; all of them where they
/// are flat.
pub(super) fn choose(points: &[[f64; 3]], tolerance: f64) -> Vec<[f64; 3]> {
    let Some((mut hull, mut taken, eps)) = start(points) else {
        return points.to_vec();
    };
    let mut looks = points.len().saturating_mul(hull.slots());
    if looks > MOST_LOOKS {
        return points.to_vec();
    }
    let mut outside: Vec<Outside> = points
        .iter()
        .filter_map(|&p| look(&hull, &taken, p, eps, tolerance))
        .collect();
    while let Some(k) = farthest(&outside) {
        let p = outside.swap_remove(k).point;
        if !hull.insert(p, eps) {
            // The hull can take no more, or rounding is in the way: leave nothing to chance.
            return points.to_vec();
        }
        taken.push(p);
        let mut gone = vec![false; hull.slots()];
        hull.removed().iter().for_each(|&f| gone[f as usize] = true);
        looks = looks.saturating_add(outside.len());
        outside.retain_mut(|o| {
            if !gone[o.face as usize] {
                return true;
            }
            looks = looks.saturating_add(gone.len());
            match look(&hull, &taken, o.point, eps, tolerance) {
                Some(again) => {
                    *o = again;
                    true
                }
                None => false,
            }
        });
        if looks > MOST_LOOKS {
            return points.to_vec();
        }
    }
    hull.used().into_iter().map(|i| taken[i]).collect()
}

struct Outside {
    point: [f64; 3],
    face: u32,
    distance: f64,
}

/// The point with the face that it is farthest above, if it is too far outside.
fn look(
    hull: &GrowingHull,
    taken: &[[f64; 3]],
    p: [f64; 3],
    eps: f64,
    tolerance: f64,
) -> Option<Outside> {
    let (face, height) = hull.farthest_face(p);
    if height <= eps {
        return None;
    }
    // Not less than the distance from the hull.
    let distance = distance_to_triangle(p, hull.face(face).map(|i| taken[i as usize]));
    (distance > tolerance).then_some(Outside {
        point: p,
        face,
        distance,
    })
}

/// The first of the farthest.
fn farthest(outside: &[Outside]) -> Option<usize> {
    let mut best: Option<usize> = None;
    for (k, o) in outside.iter().enumerate() {
        if best.is_none_or(|b| o.distance > outside[b].distance) {
            best = Some(k);
        }
    }
    best
}

/// The hull of the support points, those that it took, and a length that is nothing at their size. None
/// where the points are flat.
fn start(points: &[[f64; 3]]) -> Option<(GrowingHull, Vec<[f64; 3]>, f64)> {
    let origin = *points.first()?;
    let size = points
        .iter()
        .map(|p| norm(sub(*p, origin)))
        .fold(0.0, f64::max);
    let scaled = points.iter().map(|&p| sub(p, origin).map(|x| x / size));
    let candidates: Vec<Candidate> = scaled.zip(0..).map(|(p, i)| Candidate::new(p, i)).collect();
    let support: Vec<[f64; 3]> = support(&candidates)
        .iter()
        .filter_map(|&i| points.get(i as usize).copied())
        .collect();
    // A tetrahedron as wide as it may be: farthest pair, then farthest from the line, from the plane.
    let a = *support.first()?;
    let by = |f: &dyn Fn([f64; 3]) -> f64| {
        support
            .iter()
            .copied()
            .reduce(|m, p| if f(p) > f(m) { p } else { m })
    };
    let b = by(&|p| norm(sub(p, a)))?;
    let c = by(&|p| norm(cross(sub(b, a), sub(p, a))))?;
    let n = cross(sub(b, a), sub(c, a));
    let d = by(&|p| dot(n, sub(p, a)).abs())?;
    let (eps, jitter) = (1e-7 * size, 2e-8 * size);
    let mut hull = GrowingHull::tetrahedron([a, b, c, d], 1e-5 * size, jitter)?;
    let mut taken = vec![a, b, c, d];
    for p in support {
        if hull.insert(p, eps) {
            taken.push(p);
        }
    }
    Some((hull, taken, eps))
}
