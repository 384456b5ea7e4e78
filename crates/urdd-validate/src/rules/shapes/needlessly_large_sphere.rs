use nalgebra::Vector3;

use super::needlessly_large;
use crate::rules::prelude::*;
use crate::views::enclosure::Enclosure;
use urdd_document::shapes::Volume;
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_geometry::hull::ConvexHull;

declare_rule! {
    /// A sphere has more than 1.05 times the radius of a smaller one that holds the same hull or piece.
    ///
    /// Spheres are tested in place of what they hold: where they are larger than they need to be,
    /// programs report false collisions. Most often the centre is the mean of the vertices, or the
    /// middle of a box.
    ///
    /// Move the centre: there is one smallest sphere. `urdd generate` finds it.
    SHP020 "needlessly-large-sphere", Warning, clause "8.2", since "0.1.0",
    phase Geometry, consequence Looseness, needs [ENCLOSURES],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let words = ["sphere", "radius"];
    needlessly_large::report(context, findings, NEEDLESSLY_LARGE_SPHERE, words, ratio)
}

/// The radius of a sphere over that of the smallest one; `None` if it is surely not too large, for a box, or without a
/// hull.
fn ratio(enclosure: &Enclosure) -> Option<f64> {
    let Volume::Sphere { radius, .. } = enclosure.volume else {
        return None;
    };
    let vertices = &enclosure.mesh.vertices;
    // Well below the bound, so that rounding does not matter.
    if exceeds(vertices, radius / NEEDLESSLY_LARGE_SPHERE * (1.0 + 1e-6)) {
        return None;
    }
    let hull = ConvexHull::new(vertices).ok()?;
    Some(radius / BoundingSphere::around(&hull).radius)
}

/// Whether every sphere around these points has a larger radius than this, if a few steps show it.
///
/// The variance of the points under any weights is at most the square of the smallest radius. Each step moves weight to
/// the point farthest from the mean, as much as increases the variance most (Frank and Wolfe 1956, on the dual of the
/// smallest enclosing ball).
pub fn exceeds(points: &[[f64; 3]], radius: f64) -> bool {
    const STEPS: usize = 32;
    let mut mean = points.first().map_or_else(Vector3::zeros, |p| Vector3::from(*p));
    let mut variance = 0.0;
    for _ in 0..STEPS {
        let away = |p: &[f64; 3]| (Vector3::from(*p) - mean).norm_squared();
        let pairs = points.iter().map(|p| (away(p), p));
        let Some((squared, farthest)) = pairs.reduce(|a, b| if b.0 > a.0 { b } else { a }) else {
            return false;
        };
        let weight = (squared - variance) / (2.0 * squared);
        mean += (Vector3::from(*farthest) - mean) * weight;
        variance = (1.0 - weight) * (variance + weight * squared);
        if variance > radius * radius {
            return true;
        }
    }
    false
}
