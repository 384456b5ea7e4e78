use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::tolerance::NEEDLESSLY_LARGE_SPHERE;
use crate::views::enclosure::Enclosure;
use crate::views::judged::enclosures;
use urdd_document::shapes::Volume;
use urdd_format::registry::{ModuleKind, Profile};
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
    let mut found = Vec::new();
    for enclosure in enclosures(context, findings) {
        // A sphere that does not fit is told of by SHP017 or SHP018.
        if !enclosure.holds() || (tight && !enclosure.touches()) {
            continue;
        }
        if let Some(ratio) = ratio(&enclosure)
            && ratio > NEEDLESSLY_LARGE_SPHERE
        {
            found.push((enclosure, ratio));
        }
    }
    // The worst first: of many only a few are shown.
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    for (enclosure, ratio) in found {
        findings.report(
            Finding::at(
                module.file("module.json"),
                &enclosure.pointer,
                format!(
                    "the sphere about {} has {ratio:.2} times the radius of the least one",
                    enclosure.of_what(context)
                ),
            )
            .expected(format!("at most {NEEDLESSLY_LARGE_SPHERE} times"))
            .actual(format!("{ratio:.2} times")),
        );
    }
}

/// The radius of a sphere over that of the least one; `None` for a box, or without a hull.
fn ratio(enclosure: &Enclosure) -> Option<f64> {
    let Volume::Sphere { radius, .. } = enclosure.volume else {
        return None;
    };
    let hull = ConvexHull::new(&enclosure.mesh.vertices).ok()?;
    Some(radius / BoundingSphere::around(&hull).radius)
}
