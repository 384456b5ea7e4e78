use crate::rules::prelude::*;
use crate::views::tangled::{Tangled, diagonal_sound};
use urdd_document::shape_matrices::{
    Elements, MATRIX_MODULES, Matrix, V1_MATRIX_MODULES, matrices,
};
use urdd_document::shapes::Shapes;

declare_rule! {
    /// A matrix over shapes is not square, or not of the number of shapes.
    ///
    /// Row i and column i stand for shape i: the links that have a hull, in link order, or the convex
    /// pieces, link by link. In a matrix of another size, indices mean other shapes than its reader
    /// thinks. Most often the module is stale: hulls or pieces were made again, and it was not.
    ///
    /// Write the module again from the hulls and pieces that are there. Until sizes are right, the other rules
    /// on matrices are skipped.
    SHP005 "matrix-size", Error, clause "8.4", since "0.1.0",
    phase References, needs [
        Module(Kind::ConvexHullMeshes), Module(Kind::ConvexDecompositionMeshes), SHAPE_MATRICES_OR_MODELS,
        MESHES_LISTED, NoneFailed(&[MSH004, SHP002, SHP010]), NO_PIECE_TWICE,
    ], check matrix_size,

    /// A shape has a distance to itself, or is not to be skipped against itself.
    ///
    /// A shape is always in contact with itself: on the diagonal, distances are 0 and skips true. Where
    /// they are not, a program that runs over all pairs reports a robot in collision with itself for ever.
    ///
    /// Write 0, or true, on the diagonal.
    SHP007 "diagonal-wrong", Error, clause "8.4", since "0.1.0",
    phase References, needs [SHAPE_MATRICES, NotFailed(SHP005)], check diagonal_wrong,

    /// A matrix over convex pieces is null, though the robot has few enough of them.
    ///
    /// Such a matrix may be left out only above 500 pieces, where it would be very large. Up to that
    /// number programs count on it.
    ///
    /// Write the matrix.
    SHP015 "piece-matrix-missing", Error, clause "8.4", since "0.1.0",
    phase References, needs [Version1, Module(Kind::ConvexDecompositionMeshes), SHAPE_MATRICES, PIECES_LISTED],
    check piece_matrix_missing,
}

fn matrix_size(context: &Context, findings: &mut Findings) -> Option<()> {
    let shapes = context.shapes()?;
    for (_, module, document) in context.documents(MATRIX_MODULES) {
        let matrices = matrices(document);
        let wrong = |matrix: &Matrix| wrong_size(module, matrix, &shapes);
        let mut wrong = matrices.iter().filter_map(wrong);
        // A stale module is one mistake, though it shows in every matrix.
        let Some(mut first) = wrong.next() else { continue };
        let others = wrong.count();
        if others > 0 {
            let also = format!("; {others} more matrices of this module are of wrong sizes too");
            first.message += &also;
        }
        first.message += ": write the module again";
        findings.report(first.count(1 + others));
    }
    Some(())
}

fn wrong_size(module: &Module, matrix: &Matrix, shapes: &Shapes) -> Option<Finding> {
    let rows = matrix.elements?.row_lengths();
    let size = shapes.count(matrix.kind);
    let what = if matrix.kind.is_of_links() { "links with a hull" } else { "convex pieces" };
    if rows.len() != size {
        let message = format!("there are {size} {what}, and {} rows here", rows.len());
        let finding = finding_in(module, &matrix.pointer, message);
        let finding = finding.expected(format!("{size} rows of {size}"));
        return Some(finding.actual(format!("{} rows", rows.len())));
    }
    let row = rows.iter().position(|length| *length != size)?;
    let length = rows.get(row)?;
    let message = format!("there are {size} {what}, and {length} elements in this row");
    let finding = finding_in(module, format!("{}/{row}", matrix.pointer), message);
    let finding = finding.expected(format!("{size} elements"));
    Some(finding.actual(format!("{length} elements")))
}

fn diagonal_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    for (_, module, document) in context.documents(MATRIX_MODULES) {
        for matrix in matrices(document) {
            let Some(elements) = matrix.elements else { continue };
            let tangled = Tangled::new(elements);
            for i in 0..elements.rows() {
                // SHP006 reports a row with more faults.
                if diagonal_sound(elements, i) || tangled.asymmetric(i) {
                    continue;
                }
                let expected = match elements {
                    Elements::Distances(_) => "0",
                    _ => "true",
                };
                let message = format!(
                    "this is the element of shape {i} and itself, which is always {expected}"
                );
                let finding = finding_in(module, format!("{}/{i}/{i}", matrix.pointer), message);
                findings.report(finding.values(expected, elements.text(i, i)));
            }
        }
    }
    Some(())
}

/// Number of pieces up to which matrices over them are required (SPEC 8.4).
const REQUIRED_UP_TO: usize = 500;

fn piece_matrix_missing(context: &Context, findings: &mut Findings) -> Option<()> {
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
