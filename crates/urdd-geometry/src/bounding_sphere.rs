//! The smallest enclosing sphere of a set of points.
//!
//! E. Welzl, Smallest Enclosing Disks (Balls and Ellipsoids), New Results and New Trends in Computer Science, LNCS 555
//! (1991). The iteration is that of B. Gärtner, Fast and Robust Smallest Enclosing Balls, ESA '99: add the point
//! farthest outside, and compute the smallest sphere of that point and the support points of the previous sphere. The
//! radius grows in each step, so no support set occurs twice and the iteration ends. It is deterministic.

use nalgebra::{Matrix3, Vector3};

use super::hull::ConvexHull;
use super::mesh::Bounds;
use super::vector::{dot, norm, sub};

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingSphere {
    /// The centre, metres.
    pub centre: [f64; 3],
    /// The radius, metres.
    pub radius: f64,
}

/// A sphere and its support of up to four points, in the scaled coordinates of the iteration.
#[derive(Clone, Debug)]
struct Carried {
    support: Vec<Vector3<f64>>,
    centre: Vector3<f64>,
    radius: f64,
}

/// Points count as inside up to this fraction of the radius: some tens of rounding errors.
const ROUNDING: f64 = 1e-14;

impl BoundingSphere {
    /// The smallest enclosing sphere of a hull, up to rounding. On 447 robot meshes a lower bound (the Lagrangian dual)
    /// shows that the radius exceeds the optimum by less than 5e-9 of it. The worst cases have many points near one
    /// circle.
    ///
    /// No vertex is farther from the centre than the radius, as computed in doubles.
    pub fn around(hull: &ConvexHull) -> Self {
        Self::of_points(&hull.mesh().vertices)
    }

    /// As [`BoundingSphere::around`], for points in any order; without points, radius 0 at the origin.
    pub fn of_points(points: &[[f64; 3]]) -> Self {
        let vertices: Vec<_> = points.iter().map(|p| Vector3::from(*p)).collect();
        let first = vertices.first().copied().unwrap_or_default();
        let size = vertices.iter().fold(0.0, |size: f64, p| size.max((p - first).amax()));
        // Scale lengths to about 1, so that products neither underflow nor overflow. A power of 2 is exact.
        let scale = if size > 0.0 { size.log2().ceil().exp2() } else { 1.0 };
        let points: Vec<_> = vertices.iter().map(|p| (p - first) / scale).collect();
        let centre = first + smallest(&points) * scale;
        let radius = vertices.iter().fold(0.0, |radius: f64, p| radius.max((p - centre).norm()));
        Self { centre: centre.map(|x| x + 0.0).into(), radius }
    }
}

/// Factor that enlarges the radii of spheres that cull by more than the rounding error.
pub const LARGER: f64 = 1.0 + 1e-12;

/// A sphere with this centre around points, to cull: no point is outside, by any rounding.
pub fn about(centre: [f64; 3], points: &[[f64; 3]]) -> BoundingSphere {
    let away = points.iter().map(|p| sub(*p, centre)).map(|d| dot(d, d));
    BoundingSphere { centre, radius: away.fold(0.0, f64::max).sqrt() * LARGER + f64::MIN_POSITIVE }
}

/// A sphere around spheres, to cull; `None` without spheres.
pub fn about_spheres<'a>(
    spheres: impl Iterator<Item = &'a BoundingSphere> + Clone,
) -> Option<BoundingSphere> {
    spheres.clone().next()?;
    let ends = spheres.clone().flat_map(|sphere| {
        let end = |away: f64| sphere.centre.map(|x| x + away);
        [end(-sphere.radius), end(sphere.radius)]
    });
    let Bounds { min, max } = Bounds::of(ends);
    let centre = [0, 1, 2].map(|k| 0.5 * (min[k] + max[k]));
    let reach = spheres.map(|sphere| norm(sub(sphere.centre, centre)) + sphere.radius);
    Some(BoundingSphere { centre, radius: reach.fold(0.0, f64::max) * LARGER })
}

/// The centre of the smallest enclosing sphere.
fn smallest(points: &[Vector3<f64>]) -> Vector3<f64> {
    let Some(first) = points.first() else { return Vector3::zeros() };
    let mut sphere = Carried { support: vec![*first], centre: *first, radius: 0.0 };
    loop {
        let away = |p: &Vector3<f64>| (p - sphere.centre).norm_squared();
        let (squared, farthest) = points
            .iter()
            .map(|p| (away(p), p))
            .fold((0.0, first), |best, other| if other.0 > best.0 { other } else { best });
        if squared.sqrt() <= sphere.radius * (1.0 + ROUNDING) {
            break;
        }
        let mut carriers = sphere.support.clone();
        carriers.push(*farthest);
        match smallest_of_few(&carriers) {
            Some(larger) if larger.radius > sphere.radius => sphere = larger,
            // Only rounding errors remain.
            _ => break,
        }
    }
    sphere.centre
}

/// The smallest enclosing sphere of up to five points. Its centre is the circumcentre of a subset: the one whose
/// farthest point is nearest.
fn smallest_of_few(points: &[Vector3<f64>]) -> Option<Carried> {
    let mut best: Option<Carried> = None;
    for chosen in 1u32..1 << points.len() {
        if chosen.count_ones() > 4 {
            continue;
        }
        let picked = points.iter().enumerate().filter(|(i, _)| chosen >> i & 1 == 1);
        let support: Vec<_> = picked.map(|(_, p)| *p).collect();
        let Some(centre) = circumcentre(&support) else { continue };
        // The radius that encloses all points. The distance to the support alone could exclude one by rounding.
        let radius = points.iter().fold(0.0, |r: f64, p| r.max((p - centre).norm()));
        if best.as_ref().is_none_or(|best| radius < best.radius) {
            best = Some(Carried { support, centre, radius });
        }
    }
    best
}

/// The point in the span of one to four points (a point, line, plane or space) that is equidistant from them; `None` if
/// there is none.
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
