use crate::rules::prelude::*;
use crate::solids::derived::{Derived, noun};
use crate::solids::polytope::{Dents, NotConvex, dents, not_convex};
use urdd_geometry::surface::extent;

declare_rule! {
    /// A convex hull is not the closed surface of a convex body.
    ///
    /// Programs compute distances from its vertices, and whether a point is inside from its faces; the
    /// two agree only for a convex body. Here a vertex lies outside of a face, an edge has a face on one
    /// side only, or the faces look inward.
    ///
    /// Compute the hull of the link's plain mesh again, and write every triangle, counter-clockwise seen
    /// from outside.
    MSH017 "hull-not-convex", Error, clause "7.9", since "0.1.0",
    phase Geometry, consequence Collisions, needs [Module(Kind::ConvexHullMeshes), NotFailed(MSH003)],
    check |context, findings| report(context, Kind::ConvexHullMeshes, findings),

    /// A convex piece is not the closed surface of a convex body.
    ///
    /// As for hulls (MSH017): programs compute with its vertices or with its faces, and the two agree only
    /// for a convex body. Decompositions that write the parts of the surface instead of the hull of each
    /// part make such pieces.
    ///
    /// Write the convex hull of each piece, every triangle, counter-clockwise seen from outside.
    MSH020 "piece-not-convex", Error, clause "7.10", since "0.1.0",
    phase Geometry, consequence Collisions, needs [Module(Kind::ConvexDecompositionMeshes), NotFailed(MSH003)],
    check |context, findings| report(context, Kind::ConvexDecompositionMeshes, findings),
}

/// Reports every mesh of a module that is not the closed surface of a convex body.
fn report(context: &Context, kind: Kind, findings: &mut Findings) -> Option<()> {
    let module = context.module(kind)?;
    let judge = |mesh: &'_ Derived| {
        let solid = mesh.sound()?;
        let key = context.solids().content(kind, mesh.link, mesh.piece)?;
        let compute = || Some((not_convex(solid)?, dents(solid)));
        context.memos.convexity.get(key, compute)
    };
    let meshes = context.solids().derived(kind);
    let faults: Vec<Option<(NotConvex, Option<Dents>)>> = meshes.par_iter().map(judge).collect();
    for (mesh, fault) in meshes.iter().zip(faults) {
        let part = Part::of(kind, mesh.link, mesh.piece);
        if let (None, Some(part)) = (mesh.sound(), part) {
            findings.not_verified(part, Why::Unreadable);
        }
        let Some((fault, dents)) = fault else { continue };
        let extent = mesh.mesh.as_ref().map_or(0.0, extent);
        let resolution = mesh_resolution(extent);
        let depth = dents.map(|dents| dents.depth).filter(|depth| *depth > resolution);
        let what = match fault {
            NotConvex::Nothing => "it has no face with an area".to_owned(),
            NotConvex::Open(at) => {
                format!("the edge at {} is not shared by two faces that are wound alike", point(at))
            }
            NotConvex::Inward => "its faces are oriented inward".to_owned(),
            NotConvex::Vertex(at, _) => match dents {
                Some(dents) => in_words(&dents, depth),
                None => format!("the vertex at {} is outside of a face", point(at)),
            },
        };
        let label = context.link_label(mesh.link);
        let which = match kind {
            Kind::ConvexDecompositionMeshes => format!("piece {} of {label}", mesh.piece),
            _ => format!("the {} of {label}", noun(kind)),
        };
        let message = format!("{which} is not a convex body: {what}");
        let mut finding = finding_in(module, mesh.pointer(), message)
            .values("a closed convex surface, faces counter-clockwise seen from outside", what)
            .tolerance(resolution)
            .part(part);
        if let Some(depth) = depth {
            finding = finding.off_by(depth, "m");
        }
        findings.report(finding);
    }
    Some(())
}

/// Number of inward faces, and the deepest dent.
fn in_words(dents: &Dents, depth: Option<f64>) -> String {
    let faces = match dents.inward {
        0 => "vertices lie outside of its faces".to_owned(),
        1 => format!("1 of {} faces is oriented inward", dents.faces),
        inward => format!("{inward} of {} faces are oriented inward", dents.faces),
    };
    match depth {
        None => faces,
        Some(depth) => {
            format!("{faces}, the deepest dent is {:.3} mm, at {}", 1e3 * depth, point(dents.place))
        }
    }
}
