use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::part::Part;
use crate::rule::declare_rule;
use crate::tolerance::HULL_IN_VOLUME;
use crate::views::judged::judged;
use urdd_document::shapes::max_distances;
use urdd_format::registry::ModuleKind;
use urdd_geometry::farthest;

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
        PIECES_LISTED, OWN_FILES, SOUND_SHAPES, SHAPES_LISTED,
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
                let part = Part::of_shape(list.kind, link, piece);
                if !judged(context, findings, part, &[]) {
                    continue;
                }
                let Some(mesh) = context.solids().sound(meshes, link, piece) else {
                    continue;
                };
                let expected = farthest::of_mesh(mesh);
                let tolerance = HULL_IN_VOLUME * expected;
                if (value - expected).abs() <= tolerance {
                    continue;
                }
                let what = match list.kind.is_of_links() {
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
