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
        let mut wrong = matrices
            .iter()
            .filter_map(|matrix| wrong_size(matrix, &shapes));
        // A stale module is one mistake, though it shows in every matrix.
        let Some(first) = wrong.next() else {
            continue;
        };
        let others = wrong.count();
        let also = match others {
            0 => String::new(),
            n => format!("; {n} more matrices of this module are of wrong sizes too"),
        };
        let message = format!("{}{also}: write the module again", first.message);
        Finding::of(module, first.pointer, message)
            .expected(first.expected)
            .actual(first.actual)
            .count(1 + others)
            .report(findings);
    }
    Some(())
}

struct Wrong {
    pointer: String,
    message: String,
    expected: String,
    actual: String,
}

fn wrong_size(matrix: &Matrix, shapes: &Shapes) -> Option<Wrong> {
    let rows = matrix.elements?.row_lengths();
    let size = shapes.count(matrix.kind);
    let what = match matrix.kind.full {
        true => "links with a hull",
        false => "convex pieces",
    };
    if rows.len() != size {
        return Some(Wrong {
            pointer: matrix.pointer.clone(),
            message: format!("there are {size} {what}, and {} rows here", rows.len()),
            expected: format!("{size} rows of {size}"),
            actual: format!("{} rows", rows.len()),
        });
    }
    let row = rows.iter().position(|length| *length != size)?;
    let length = rows.get(row)?;
    Some(Wrong {
        pointer: format!("{}/{row}", matrix.pointer),
        message: format!("there are {size} {what}, and {length} elements in this row"),
        expected: format!("{size} elements"),
        actual: format!("{length} elements"),
    })
}
