use crate::document::shapes::max_distances;
use crate::format::registry::ModuleKind;
use crate::geometry::farthest;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::rule::declare_rule;
use crate::validate::tolerance::HULL_IN_VOLUME;

declare_rule! {
    /// The largest distance of a hull or piece from its link's origin is not that of its farthest vertex.
    ///
    /// Programs bound by it how far a link's points move when joints turn; where it is too small, they
    /// miss collisions.
    ///
    /// Write the distance of the farthest vertex from the origin of the link's frame, as the mesh file
    /// has it.
    SHP021 "hull-distance-wrong", Error, clause "8.3", since "0.1.0",
    phase Geometry, needs [
        Module(Kind::LinkShapesMaxDistanceFromOrigin),
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
        // What reaches farther than the box and the sphere is told of already.
        NotFailed(SHP004),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesMaxDistanceFromOrigin;
    let (Some(module), Some(lists)) = (
        context.module(kind),
        context.document(kind).and_then(max_distances),
    ) else {
        return;
    };
    let [hulls, _, _, pieces, _, _] = &lists;
    for (list, meshes) in [
        (hulls, ModuleKind::ConvexHullMeshes),
        (pieces, ModuleKind::ConvexDecompositionMeshes),
    ] {
        for (link, entry) in list.links.iter().enumerate() {
            for (piece, value) in entry.iter().enumerate() {
                let Some(mesh) = context.solids().sound(meshes, link, piece) else {
                    continue;
                };
                let expected = farthest::of_mesh(mesh);
                let tolerance = HULL_IN_VOLUME * expected;
                if (value - expected).abs() <= tolerance {
                    continue;
                }
                let what = match list.kind.full {
                    true => "the hull".to_owned(),
                    false => format!("piece {piece}"),
                };
                findings.report(
                    Finding::at(
                        module.file("module.json"),
                        list.pointer(link, piece),
                        format!(
                            "this is not the distance of the farthest vertex of {what} of {}",
                            context.link_label(link)
                        ),
                    )
                    .expected(expected)
                    .actual(value)
                    .tolerance(tolerance)
                    .off_by(value - expected, "m"),
                );
            }
        }
    }
}
