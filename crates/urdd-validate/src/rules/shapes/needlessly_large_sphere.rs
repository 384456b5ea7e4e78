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

/// The radius of a sphere over that of the smallest one; `None` for a box, or without a hull.
fn ratio(enclosure: &Enclosure) -> Option<f64> {
    let Volume::Sphere { radius, .. } = enclosure.volume else {
        return None;
    };
    let hull = ConvexHull::new(&enclosure.mesh.vertices).ok()?;
    Some(radius / BoundingSphere::around(&hull).radius)
}
