//! The smallest sphere about a set of points.
//!
//! E. Welzl, Smallest Enclosing Disks (Balls and Ellipsoids), New Results and New Trends in Computer
//! Science, LNCS 555 (1991); the way to walk is that of B. Gärtner, Fast and Robust Smallest
//! Enclosing Balls, ESA '99: take in the point farthest outside, and find the smallest sphere about
//! it and the few points that carried the last one. That one is larger each time, so no set of
//! points carries twice, and the walk ends. There is no chance in it.

use nalgebra::{Matrix3, Vector3};

use super::hull::ConvexHull;

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingSphere {
    /// The centre, metres.
    pub centre: [f64; 3],
    /// The radius, metres.
    pub radius: f64,
}

/// A sphere through up to four points; lengths and origin are those of the walk.
#[derive(Clone, Debug)]
struct Carried {
    support: Vec<Vector3<f64>>,
    centre: Vector3<f64>,
    radius: f64,
}

/// Points count as inside up to this part of the radius: some tens of roundings.
const ROUNDING: f64 = 1e-14;

impl BoundingSphere {
    /// The smallest sphere about a hull, but for rounding. On 447 meshes of robots a lower bound
    /// (the Lagrangian dual) shows that no sphere's radius is smaller by more than 5e-9 of it; it
    /// takes many points near one circle to come to that.
    ///
    /// No vertex is farther from the centre than the radius, computed in doubles.
    pub fn around(hull: &ConvexHull) -> Self {
        Self::of_points(&hull.mesh().vertices)
    }

    /// As [`BoundingSphere::around`], of points in any order and place; at the origin, and of radius 0, without any.
    pub fn of_points(points: &[[f64; 3]]) -> Self {
        let vertices: Vec<_> = points.iter().map(|p| Vector3::from(*p)).collect();
        let first = vertices.first().copied().unwrap_or_default();
        let size = vertices
            .iter()
            .fold(0.0, |size: f64, p| size.max((p - first).amax()));
        // Lengths about 1, in which no product under- or overflows. A power of 2 changes no digit.
        let scale = if size > 0.0 {
            size.log2().ceil().exp2()
        } else {
            1.0
        };
        let points: Vec<_> = vertices.iter().map(|p| (p - first) / scale).collect();
        let centre = first + smallest(&points) * scale;
        let radius = vertices
            .iter()
            .fold(0.0, |radius: f64, p| radius.max((p - centre).norm()));
        Self {
            centre: centre.map(|x| x + 0.0).into(),
            radius,
        }
    }
}

/// The centre of the smallest sphere about points.
fn smallest(points: &[Vector3<f64>]) -> Vector3<f64> {
    let Some(first) = points.first() else {
        return Vector3::zeros();
    };
    let mut sphere = Carried {
        support: vec![*first],
        centre: *first,
        radius: 0.0,
    };
    loop {
        let away = |p: &Vector3<f64>| (p - sphere.centre).norm_squared();
        let farthest = points
            .iter()
            .map(|p| (away(p), p))
            .reduce(|best, other| if other.0 > best.0 { other } else { best });
        let Some((squared, farthest)) = farthest else {
            break;
        };
        if squared.sqrt() <= sphere.radius * (1.0 + ROUNDING) {
            break;
        }
        let mut carriers = sphere.support.clone();
        carriers.push(*farthest);
        match smallest_of_few(&carriers) {
            Some(larger) if larger.radius > sphere.radius => sphere = larger,
            // Only rounding is left.
            _ => break,
        }
    }
    sphere.centre
}

/// The smallest sphere about up to five points. Its centre is the circumcentre of some of them, of
/// all such the one nearest to the farthest of the points.
fn smallest_of_few(points: &[Vector3<f64>]) -> Option<Carried> {
    let mut best: Option<Carried> = None;
    for chosen in 1u32..1 << points.len() {
        if chosen.count_ones() > 4 {
            continue;
        }
        let picked = points
            .iter()
            .enumerate()
            .filter(|(i, _)| chosen >> i & 1 == 1);
        let support: Vec<_> = picked.map(|(_, p)| *p).collect();
        let Some(centre) = circumcentre(&support) else {
            continue;
        };
        // How far the sphere must reach to hold them all; the support alone would leave it to
        // rounding whether it does.
        let radius = points
            .iter()
            .fold(0.0, |r: f64, p| r.max((p - centre).norm()));
        if best.as_ref().is_none_or(|best| radius < best.radius) {
            best = Some(Carried {
                support,
                centre,
                radius,
            });
        }
    }
    best
}

/// The point of their plane, line or space that is as far from each of one to four points; `None`
/// if there is none.
fn circumcentre(points: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let (origin, rest) = points.split_first()?;
    let from_origin = |k: usize| rest[k] - origin;
    let offset = match rest.len() {
        0 => Vector3::zeros(),
        1 => from_origin(0) * 0.5,
        2 => {
            let (u, v) = (from_origin(0), from_origin(1));
            let normal = u.cross(&v);
            let towards = v * u.norm_squared() - u * v.norm_squared();
            towards.cross(&normal) * 0.5 / normal.norm_squared()
        }
        _ => {
            let [u, v, w] = [0, 1, 2].map(from_origin);
            let rows = Matrix3::from_rows(&[u.transpose(), v.transpose(), w.transpose()]);
            let halves = Vector3::new(u.norm_squared(), v.norm_squared(), w.norm_squared()) * 0.5;
            rows.full_piv_lu().solve(&halves)?
        }
    };
    let centre = origin + offset;
    centre.iter().all(|x| x.is_finite()).then_some(centre)
}
