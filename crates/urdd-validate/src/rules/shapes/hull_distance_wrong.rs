use crate::rules::prelude::*;
use urdd_document::shapes::max_distances;
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
        HULLS_OR_PIECES,
        PIECES_LISTED, OWN_FILES, SOUND_SHAPES, SHAPES_LISTED,
        // It reports a value beyond the box and the sphere.
        NotFailed(SHP004),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesMaxDistanceFromOrigin;
    let [hulls, _, _, pieces, _, _] = max_distances(context.document(kind)?)?;
    for (list, meshes) in
        [(hulls, Kind::ConvexHullMeshes), (pieces, Kind::ConvexDecompositionMeshes)]
    {
        for (link, piece, value) in list.entries() {
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
            let message = format!(
                "this is not the distance of the farthest vertex of {what} of {}",
                context.link_label(link)
            );
            finding_in(Kind::LinkShapesMaxDistanceFromOrigin, list.pointer(link, piece), message)
                .values(expected, value)
                .tolerance(tolerance)
                .off_by(value - expected, "m")
                .report(findings);
        }
    }
    Some(())
}
