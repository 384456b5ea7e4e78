use crate::context::Context;
use crate::finding::{Finding, Findings, point};
use crate::rule::declare_rule;
use crate::views::judged::enclosures;
use urdd_format::readable::metres;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// A box or sphere leaves out a part of the hull or piece that it should hold.
    ///
    /// Programs test boxes and spheres first, and look no further where these are apart: a part that
    /// sticks out is never tested, and collisions with it are missed. Most often the box or sphere was
    /// made of another mesh, or its rotation is taken the other way round.
    ///
    /// Make it again from the vertices of the hull or piece, as its file has them.
    SHP017 "shape-leaves-out-part", Error, clause "8.2", since "0.1.0",
    phase Geometry, needs [
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
        if enclosure.holds() {
            continue;
        }
        let (vertex, away) = enclosure.fit.outside;
        let place = enclosure.mesh.vertices.get(vertex).copied();
        findings.report(
            Finding::at(
                module.file("module.json"),
                &enclosure.pointer,
                format!(
                    "the {} leaves out a part of {}: the vertex at {} is {} outside",
                    enclosure.noun(),
                    enclosure.of_what(context),
                    point(place.unwrap_or_default()),
                    metres(away),
                ),
            )
            .expected("every vertex inside")
            .actual(format!("{} outside", metres(away)))
            .tolerance(enclosure.tolerance)
            .off_by(away, "m"),
        );
    }
}
