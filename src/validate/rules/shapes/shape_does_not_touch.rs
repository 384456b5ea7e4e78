use crate::format::registry::ModuleKind;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings, metres};
use crate::validate::rule::declare_rule;
use crate::validate::views::enclosure::{Side, enclosures};

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
        NotFailed(MSH001),
        NotFailed(MSH004),
        NotFailed(MSH005),
        NotFailed(MSH007),
        // What these find is wrong with the hulls and pieces themselves.
        NotFailedInV1(MSH017),
        NotFailedInV1(MSH018),
        NotFailedInV1(MSH019),
        NotFailedInV1(MSH020),
        NotFailedInV1(MSH021),
        NotFailedInV1(MSH022),
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
    for enclosure in enclosures(context, context.solids()) {
        // What leaves a part out stands off on the other side: SHP017 tells.
        if !enclosure.holds() || enclosure.touches() {
            continue;
        }
        let (side, off) = enclosure.fit.off;
        let what = enclosure.of_what(context);
        let message = match side {
            Side::Round => format!("the sphere is {} off {what} all round", metres(off)),
            Side::Of(axis, upper) => format!(
                "the box's side at its own {}{} is {} off {what}",
                if upper { '+' } else { '-' },
                ['x', 'y', 'z'].get(axis).copied().unwrap_or_default(),
                metres(off),
            ),
        };
        findings.report(
            Finding::at(module.file("module.json"), &enclosure.pointer, message)
                .expected("a vertex on every side")
                .actual(format!("{off} m off"))
                .tolerance(enclosure.tolerance)
                .off_by(off, "m"),
        );
    }
}
