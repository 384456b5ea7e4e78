use crate::rules::prelude::*;
use urdd_document::shapes::{ShapeList, Volume, approximations, max_distances};
use urdd_geometry::farthest;

declare_rule! {
    /// A shape's largest distance from its link's origin is not what its box or sphere gives.
    ///
    /// The value is exact for a box (its farthest corner) and for a sphere (distance of its centre, plus
    /// its radius), and a hull or convex piece cannot reach farther than the box and the sphere that
    /// hold it. Programs bound by it how far a link's points move when joints turn; where it is too
    /// small, they miss collisions.
    ///
    /// Write the value from the same boxes and spheres as `link_shapes_approximations_module`. (Legacy
    /// spheres were measured at the corners of a tessellated one: up to 0.5 % of the radius too little passes.)
    SHP004 "max-distance-wrong", Error, clause "8.3", since "0.1.0",
    phase References, needs [
        Module(Kind::LinkShapesApproximations), Module(Kind::LinkShapesMaxDistanceFromOrigin), NotFailed(MSH004),
        SHAPES_LISTED, NotFailed(SHP003),
        // The distance may be that of the right box, where the box itself does not fit.
        NotFailed(SHP017), NotFailed(SHP018),
    ], check max_distance_wrong,

    /// The largest distance of a hull or piece from its link's origin is not that of its farthest vertex.
    ///
    /// Programs bound by it how far a link's points move when joints turn; where it is too small, they
    /// miss collisions.
    ///
    /// Write the distance of the farthest vertex from the origin of the link's frame, as the mesh file
    /// has it.
    SHP021 "hull-distance-wrong", Error, clause "8.3", since "0.1.0",
    phase Geometry, needs [
        Module(Kind::LinkShapesMaxDistanceFromOrigin), HULLS_OR_PIECES, PIECES_LISTED, OWN_FILES, SOUND_SHAPES,
        SHAPES_LISTED,
        // It reports a value beyond the box and the sphere.
        NotFailed(SHP004),
    ], check hull_distance_wrong,
}

fn max_distance_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesMaxDistanceFromOrigin;
    let document = context.document(kind)?;
    let distances = max_distances(document)?;
    let [full_hulls, full_box_values, full_sphere_values, pieces, box_values, sphere_values] =
        &distances;
    let volumes = approximations(context.document(Kind::LinkShapesApproximations)?)?;
    let [full_boxes, full_spheres, boxes, spheres] = &volumes;
    let module = context.module(kind)?;
    for (values, volumes) in [
        (full_box_values, full_boxes),
        (full_sphere_values, full_spheres),
        (box_values, boxes),
        (sphere_values, spheres),
    ] {
        for (link, piece, value) in values.entries() {
            let Some(volume) = entry(volumes, link, piece) else { continue };
            let expected = volume.reach();
            let tolerance = number_tolerance(expected, value);
            let shortfall = match volume {
                Volume::Sphere { radius, .. } if module.is_legacy() => {
                    radius * LEGACY_SPHERE_SHORTFALL
                }
                _ => tolerance,
            };
            if value > expected + tolerance || value < expected - shortfall {
                let what = match volume {
                    Volume::Sphere { .. } => "distance of the sphere's centre plus its radius",
                    Volume::Box { .. } => "distance of the box's farthest corner",
                };
                let message = format!(
                    "this is not the {what} ({}) for {}",
                    volumes.pointer(link, piece),
                    context.link_label(link)
                );
                finding_in(module, values.pointer(link, piece), message)
                    .values(expected, value)
                    .tolerance(shortfall.max(tolerance))
                    .report(findings);
            }
        }
    }
    // Hulls and pieces are inside their boxes and spheres.
    for (values, around) in [(full_hulls, [full_boxes, full_spheres]), (pieces, [boxes, spheres])] {
        for (link, piece, value) in values.entries() {
            let volumes = around.map(|list| entry(list, link, piece));
            let reaches = volumes.iter().flatten().map(Volume::reach);
            let most = reaches.fold(f64::INFINITY, f64::min);
            let tolerance = most * HULL_IN_VOLUME;
            let label = context.link_label(link);
            let message = if value < 0.0 {
                format!("a distance cannot be negative ({label})")
            } else if value > most + tolerance {
                format!("{label} reaches farther here than the box and the sphere that enclose it")
            } else {
                continue;
            };
            finding_in(module, values.pointer(link, piece), message)
                .values(format!("from 0 to {most}"), value)
                .tolerance(tolerance)
                .report(findings);
        }
    }
    Some(())
}

fn entry(list: &ShapeList<Volume>, link: usize, piece: usize) -> Option<Volume> {
    list.links.get(link)?.get(piece).copied()
}

fn hull_distance_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
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
            let Some(mesh) = context.solids().sound(meshes, link, piece) else { continue };
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
