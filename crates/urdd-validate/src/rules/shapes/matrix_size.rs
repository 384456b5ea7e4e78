use crate::rules::prelude::*;
use urdd_document::shape_matrices::{MATRIX_MODULES, Matrix, matrices};
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
        MESHES_LISTED, NotFailed(MSH004), NotFailed(SHP002), NotFailed(SHP010), NO_PIECE_TWICE,
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let shapes = context.shapes()?;
    for (_, module, document) in context.documents(MATRIX_MODULES) {
        let matrices = matrices(document);
        let wrong = |matrix: &Matrix| wrong_size(module, matrix, &shapes);
        let mut wrong = matrices.iter().filter_map(wrong);
        // A stale module is one mistake, though it shows in every matrix.
        let Some(mut first) = wrong.next() else {
            continue;
        };
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
