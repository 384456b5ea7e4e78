use crate::rules::prelude::*;
use urdd_document::shape_matrices::{V1_MATRIX_MODULES, matrices};

declare_rule! {
    /// A matrix over convex pieces is null, though the robot has few enough of them.
    ///
    /// Such a matrix may be left out only above 500 pieces, where it would be very large. Up to that
    /// number programs count on it.
    ///
    /// Write the matrix.
    SHP015 "piece-matrix-missing", Error, clause "8.4", since "0.1.0",
    phase References, needs [Version1, Module(Kind::ConvexDecompositionMeshes), SHAPE_MATRICES, PIECES_LISTED],
}

/// Number of pieces up to which matrices over them are required (SPEC 8.4).
const REQUIRED_UP_TO: usize = 500;

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let meshes = context.meshes(Kind::ConvexDecompositionMeshes)?;
    let pieces: usize = (0..meshes.num_links()).map(|link| meshes.count(link)).sum();
    if pieces > REQUIRED_UP_TO {
        return Some(());
    }
    for (_, module, document) in context.documents(V1_MATRIX_MODULES) {
        let mut missing = matrices(document);
        missing.retain(|matrix| matrix.elements.is_none());
        let missing: Vec<String> = missing.into_iter().map(|matrix| matrix.pointer).collect();
        // A module written without them is one mistake.
        if let Some(first) = missing.first() {
            let message = format!(
                "with {pieces} convex pieces the matrices over them are required, and null here: {}",
                missing.join(", ")
            );
            let finding = finding_in(module, first, message).count(missing.len());
            findings.report(finding.values("a matrix", "null"));
        }
    }
    Some(())
}
