use super::needlessly_large;
use crate::rules::prelude::*;
use crate::views::enclosure::Enclosure;
use urdd_document::shapes::Volume;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::oriented_box::OrientedBox;

declare_rule! {
    /// A box has more than 1.1 times the volume of a smaller one that holds the same hull or piece.
    ///
    /// Boxes are tested in place of what they hold: excess volume causes false collisions, and
    /// paths that are not found. For a flat hull or piece areas are compared, as volumes are of
    /// boxes thickened by a millionth of the reach.
    ///
    /// Turn the box: of all orientations one has the least volume. `urdd generate` finds it.
    SHP019 "needlessly-large-box", Warning, clause "8.2", since "0.1.0",
    phase Geometry, consequence Looseness, needs [ENCLOSURES],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let words = ["box", "volume"];
    needlessly_large::report(context, findings, NEEDLESSLY_LARGE_BOX, words, ratio)
}

/// The volume of a box over that of the smallest one. `None` if it is not too large, for a sphere, or without a hull.
fn ratio(enclosure: &Enclosure) -> Option<f64> {
    let Volume::Box { half_extents, .. } = enclosure.volume else {
        return None;
    };
    // A box around a flat hull has no thickness.
    let thick = |half: [f64; 3]| half.map(|h| h + enclosure.tolerance).iter().product::<f64>();
    // Most boxes are not too large, which is found quickly.
    let may_be = |hull: &ConvexHull| {
        let enough = 8.0 * thick(half_extents) / NEEDLESSLY_LARGE_BOX;
        hull.is_flat() || OrientedBox::exists_within(hull, enough)
    };
    let vertices = &enclosure.mesh.vertices;
    // The smallest box of some vertices is found much faster, and no box around all of them is smaller.
    let some = ConvexHull::new(&outermost(vertices)).ok();
    if some.is_some_and(|hull| !may_be(&hull)) {
        return None;
    }
    let hull = ConvexHull::new(vertices).ok().filter(may_be)?;
    let least = OrientedBox::around(&hull);
    Some(thick(half_extents) / thick(least.half_extents))
}

/// The farthest vertices in the directions of a coarse grid.
fn outermost(vertices: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let steps = [-2.0, -1.0, 0.0, 1.0, 2.0];
    let directions = steps
        .into_iter()
        .flat_map(|x| steps.into_iter().map(move |y| [x, y]))
        .flat_map(|[x, y]| steps.into_iter().map(move |z| [x, y, z]));
    let farthest = directions.filter_map(|[x, y, z]| {
        let along = |p: &[f64; 3]| x * p[0] + y * p[1] + z * p[2];
        let pairs = vertices.iter().map(|p| (along(p), *p));
        pairs.reduce(|best, next| if next.0 > best.0 { next } else { best }).map(|(_, p)| p)
    });
    farthest.collect()
}
