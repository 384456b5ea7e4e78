use rayon::prelude::*;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::tolerance::NEEDLESSLY_LARGE_BOX;
use crate::views::enclosure::Enclosure;
use crate::views::judged::enclosures;
use urdd_document::shapes::Volume;
use urdd_format::registry::{ModuleKind, Profile};
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
    phase Geometry, consequence Looseness, needs [
        Module(Kind::LinkShapesApproximations),
        AnyModule(&[Kind::ConvexHullMeshes, Kind::ConvexDecompositionMeshes]),
        PIECES_LISTED, OWN_FILES, SOUND_SHAPES, SHAPES_LISTED, NotFailed(SHP003),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some(module) = context.module(ModuleKind::LinkShapesApproximations) else {
        return;
    };
    let tight = context.profile() == Profile::V1;
    // A box that does not fit is told of by SHP017 or SHP018.
    let sound = |e: &Enclosure| e.holds() && (e.touches() || !tight);
    let mut found: Vec<(Enclosure, f64)> = enclosures(context, findings)
        .into_par_iter()
        .filter(sound)
        .filter_map(|enclosure| {
            let ratio = too_large(&enclosure)?;
            Some((enclosure, ratio))
        })
        .collect();
    // The worst first: of many only a few are shown.
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    for (enclosure, ratio) in found {
        findings.report(
            Finding::at(
                module.file("module.json"),
                &enclosure.pointer,
                format!(
                    "the box about {} has {ratio:.2} times the volume of the least one",
                    enclosure.of_what(context)
                ),
            )
            .expected(format!("at most {NEEDLESSLY_LARGE_BOX} times"))
            .actual(format!("{ratio:.2} times")),
        );
    }
}

/// The volume of a box over that of the least one, where that is too large; `None` too for a sphere,
/// or without a hull.
fn too_large(enclosure: &Enclosure) -> Option<f64> {
    let Volume::Box { half_extents, .. } = enclosure.volume else {
        return None;
    };
    // A box has no thickness where its hull is flat.
    let thick = |half: [f64; 3]| {
        let half = half.map(|h| h + enclosure.tolerance);
        half.iter().product::<f64>()
    };
    // Of what may well be too large: most boxes are not, and that is seen soon.
    let may_be = |hull: &ConvexHull| {
        let enough = 8.0 * thick(half_extents) / NEEDLESSLY_LARGE_BOX;
        hull.is_flat() || OrientedBox::exists_within(hull, enough)
    };
    let ratio_to = |hull: &ConvexHull| {
        let least = OrientedBox::around(hull);
        thick(half_extents) / thick(least.half_extents)
    };
    let vertices = &enclosure.mesh.vertices;
    // No box about all is smaller than the least one about some, which is found much sooner.
    let some = ConvexHull::new(&outermost(vertices)).ok();
    if some.is_some_and(|hull| !may_be(&hull)) {
        return None;
    }
    let hull = ConvexHull::new(vertices).ok()?;
    if !may_be(&hull) {
        return None;
    }
    Some(ratio_to(&hull)).filter(|ratio| *ratio > NEEDLESSLY_LARGE_BOX)
}

/// The vertices that are farthest in the directions of a coarse grid.
fn outermost(vertices: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let steps = [-2.0, -1.0, 0.0, 1.0, 2.0];
    let directions = steps
        .into_iter()
        .flat_map(|x| steps.into_iter().map(move |y| [x, y]))
        .flat_map(|[x, y]| steps.into_iter().map(move |z| [x, y, z]));
    let farthest = directions.filter_map(|[x, y, z]| {
        let along = |p: &[f64; 3]| x * p[0] + y * p[1] + z * p[2];
        let pairs = vertices.iter().map(|p| (along(p), *p));
        let most = pairs.reduce(|best, next| if next.0 > best.0 { next } else { best });
        most.map(|(_, p)| p)
    });
    farthest.collect()
}
