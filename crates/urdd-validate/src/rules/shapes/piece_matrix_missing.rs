use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::shape_matrices::{V1_MATRIX_MODULES, matrices};
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// A matrix over convex pieces is null, though the robot has few enough of them.
    ///
    /// Such a matrix may be left out only above 500 pieces, where it would be very large. Up to that
    /// number programs count on it.
    ///
    /// Write the matrix.
    SHP015 "piece-matrix-missing", Error, clause "8.4", since "0.1.0",
    phase References, needs [
        Version1,
        Module(Kind::ConvexDecompositionMeshes),
        AnyModule(&[
            Kind::LinkShapesDistanceStatistics,
            Kind::LinkShapesSimpleSkips,
            Kind::LinkShapesSkips,
        ]),
        PIECES_LISTED,
    ],
    check check,
}

/// Most pieces with which matrices over them are required (SPEC 8.4).
const MOST_PIECES: usize = 500;

fn check(context: &Context, findings: &mut Findings) {
    let Some(meshes) = context.meshes(ModuleKind::ConvexDecompositionMeshes) else {
        return;
    };
    let pieces: usize = (0..meshes.num_links()).map(|link| meshes.count(link)).sum();
    if pieces > MOST_PIECES {
        return;
    }
    for kind in V1_MATRIX_MODULES {
        let (Some(document), Some(module)) = (context.document(*kind), context.module(*kind))
        else {
            continue;
        };
        let missing: Vec<String> = matrices(document)
            .into_iter()
            .filter(|matrix| matrix.elements.is_none())
            .map(|matrix| matrix.pointer)
            .collect();
        // A module written without them is one mistake.
        let Some(first) = missing.first() else {
            continue;
        };
        findings.report(
            Finding::at(
                module.file("module.json"),
                first,
                format!(
                    "with {pieces} convex pieces the matrices over them are required, and null here: {}",
                    missing.join(", ")
                ),
            )
            .expected("a matrix")
            .actual("null")
            .count(missing.len()),
        );
    }
}
