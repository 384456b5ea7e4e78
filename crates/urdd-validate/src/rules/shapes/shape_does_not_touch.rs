use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::views::enclosure::Side;
use crate::views::judged::enclosures;
use urdd_format::readable::metres;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// A box does not touch its hull or piece on all six sides, or a sphere does not touch it.
    ///
    /// The extents of a box follow from its orientation, and the radius of a sphere from its centre:
    /// larger ones hold the same and are farther from nothing. A side that stands off is a sign that the
    /// numbers were made of another mesh, or with a margin, which whoever wants one adds alone.
    ///
    /// Keep the orientation, and take the least and the largest coordinate of the vertices along each of
    /// the box's axes; keep the centre of a sphere, and take the distance of the farthest vertex.
    SHP018 "shape-does-not-touch", Error, clause "8.2", since "0.1.0",
    phase Geometry, needs [
        Version1,
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
    for enclosure in enclosures(context, findings) {
        // What leaves a part out stands off on the other side: SHP017 tells.
        if !enclosure.holds() || enclosure.touches() {
            continue;
        }
        let (side, off) = enclosure.fit.off;
        let what = enclosure.of_what(context);
        let message = match side {
            Side::Round => format!(
                "the sphere is {} away from {what} on all sides",
                metres(off)
            ),
            Side::Of(axis, upper) => format!(
                "the box's side at its own {}{} is {} away from {what}",
                if upper { '+' } else { '-' },
                ['x', 'y', 'z'].get(axis).copied().unwrap_or_default(),
                metres(off),
            ),
        };
        findings.report(
            Finding::at(module.file("module.json"), &enclosure.pointer, message)
                .expected("a vertex on every side")
                .actual(format!("{} away", metres(off)))
                .tolerance(enclosure.tolerance)
                .off_by(off, "m"),
        );
    }
}
