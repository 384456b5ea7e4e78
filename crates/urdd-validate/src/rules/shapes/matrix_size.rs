use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
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
        Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes),
        AnyModule(&[
            Kind::LinkShapesDistanceStatistics,
            Kind::LinkShapesSimpleSkips,
            Kind::LinkShapesSkips,
            Kind::LinkShapesLieAlgErrorModels,
        ]),
        MESHES_LISTED,
        NotFailed(MSH004),
        NotFailed(SHP002),
        NotFailed(SHP010),
        NO_PIECE_TWICE,
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some(shapes) = context.shapes() else {
        return;
    };
    for kind in MATRIX_MODULES {
        let (Some(document), Some(module)) = (context.document(*kind), context.module(*kind))
        else {
            continue;
        };
        let wrong: Vec<Wrong> = matrices(document)
            .iter()
            .filter_map(|matrix| wrong_size(matrix, &shapes))
            .collect();
        let Some(first) = wrong.first() else {
            continue;
        };
        // A stale module is one mistake, though it shows in every matrix.
        let also = match wrong.len() - 1 {
            0 => String::new(),
            n => format!("; {n} more matrices of this module are of wrong sizes too"),
        };
        findings.report(
            Finding::at(
                module.file("module.json"),
                first.pointer.clone(),
                format!("{}{also}: write the module again", first.message),
            )
            .expected(first.expected.clone())
            .actual(first.actual.clone())
            .count(wrong.len()),
        );
    }
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
    let what = match matrix.kind.is_of_links() {
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
