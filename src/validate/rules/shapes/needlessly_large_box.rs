use rayon::prelude::*;

use crate::format::registry::{ModuleKind, Profile};
use crate::geometry::hull::ConvexHull;
use crate::geometry::oriented_box::OrientedBox;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::rule::declare_rule;
use crate::validate::tolerance::NEEDLESSLY_LARGE_BOX;
use crate::validate::views::enclosure::{Enclosure, enclosures};
use crate::validate::views::shapes::Volume;

declare_rule! {
    /// A box has more than 1.1 times the volume of a smaller one that holds the same hull or piece.
    ///
    /// Boxes are tested in place of what they hold: each too much of volume is a collision that is none,
    /// and a path that is not found. For a flat hull or piece areas are compared, as volumes are of boxes
    /// thickened by a millionth of the reach.
    ///
    /// Turn the box: of all orientations one has the least volume. `urdd generate` finds it.
    SHP019 "needlessly-large-box", Warning, clause "8.2", since "0.1.0",
    phase Geometry, needs [
        Module(Kind::LinkShapesApproximations),
        AnyModule(&[Kind::ConvexHullMeshes, Kind::ConvexDecompositionMeshes]),
        NotFailed(MSH001),
        NotFailed(MSH004),
        NotFailed(MSH005),
        NotFailed(MSH007),
        NotFailed(SHP001),
        NotFailed(SHP002),
        NotFailed(SHP003),
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
    let mut found: Vec<(Enclosure, f64)> = enclosures(context)
        .into_par_iter()
        .filter(sound)
        .filter_map(|enclosure| {
            let ratio = ratio(&enclosure)?;
            (ratio > NEEDLESSLY_LARGE_BOX).then_some((enclosure, ratio))
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

/// The volume of a box over that of the least one; `None` for a sphere, or without a hull.
fn ratio(enclosure: &Enclosure) -> Option<f64> {
    let Volume::Box { half_extents, .. } = enclosure.volume else {
        return None;
    };
    // A box has no thickness where its hull is flat.
    let thick = |half: [f64; 3]| {
        half.map(|h| h + enclosure.tolerance)
            .iter()
            .product::<f64>()
    };
    let volume = thick(half_extents);
    let hull = ConvexHull::new(&enclosure.mesh.vertices).ok()?;
    let least = OrientedBox::around(&hull);
    Some(volume / thick(least.half_extents))
}
