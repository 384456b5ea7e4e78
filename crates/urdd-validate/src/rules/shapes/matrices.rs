use crate::rules::prelude::*;
use crate::views::tangled::{Tangled, diagonal_sound, of_pair, pairs, symmetric_at};
use urdd_document::shape_matrices::{
    Elements, MATRIX_MODULES, Matrix, V1_MATRIX_MODULES, at, matrices, reasons, skips,
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

    /// A matrix over shapes is not symmetric: a pair has one value one way round and another the other.
    ///
    /// The distance of A to B is that of B to A, and a check that is skipped between A and B is skipped
    /// between B and A. With an asymmetric skip matrix, whether a collision is seen depends on the order
    /// in which a program happens to name the pair. Most often one of two elements was edited by hand.
    ///
    /// Set both elements of each pair. In `link_shapes_skips_module`, the message says which of the two
    /// is not what the other modules give: that one is the edit. Where the edit is meant, set both to it;
    /// else set both back.
    SHP006 "asymmetric-matrix", Error, clause "8.4", since "0.1.0",
    phase References, needs [SHAPE_MATRICES_OR_MODELS, NotFailed(SHP005)], check asymmetric_matrix,
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

fn asymmetric_matrix(context: &Context, findings: &mut Findings) -> Option<()> {
    let shapes = context.shapes();
    for (kind, module, document) in context.documents(MATRIX_MODULES) {
        for matrix in matrices(document) {
            let Some(elements) = matrix.elements else { continue };
            let name = |shape: usize| match &shapes {
                Some(shapes) => shapes.describe(context, matrix.kind, shape),
                None => shape.to_string(),
            };
            let mut fold = Fold::new(findings);
            for (i, j) in pairs(elements.rows()) {
                if symmetric_at(elements, i, j) {
                    continue;
                }
                let edited = edited_half(context, kind, &matrix, i, j);
                fold.add(|| {
                    let (i, j) = edited.unwrap_or((i, j));
                    let (a, b) = (name(i), name(j));
                    let pointer = format!("{}/{i}/{j}", matrix.pointer);
                    let mirror = format!("{}/{j}/{i}", matrix.pointer);
                    let (here, there) = (elements.text(i, j), elements.text(j, i));
                    if edited.is_some() {
                        let message = format!(
                            "shapes {a} and {b} are skipped in one half of the matrix only: this half is an edit, \
                             {mirror} is what the simple skips give; set both to the edit, or both back"
                        );
                        return finding_in(module, pointer, message)
                            .expected(format!("the same as at {mirror}"))
                            .actual(format!("{here}, and {there} there"));
                    }
                    let message = format!(
                        "shapes {a} and {b} have different values in the two halves of the matrix: make them equal"
                    );
                    let finding = finding_in(module, pointer, message)
                        .values(format!("{there}, as at {mirror}"), here);
                    match elements {
                        Elements::Distances(_) | Elements::Models(_) => {
                            finding.tolerance(NUMBER_RELATIVE)
                        }
                        Elements::Skips(_) | Elements::Reasons(_) => finding,
                    }
                });
            }
        }
    }
    Some(())
}

/// Of two elements of a skip matrix that differ, the place of the edited one. `None` in other modules, and if the value
/// before the edits is unknown.
fn edited_half(
    context: &Context,
    module: Kind,
    matrix: &Matrix,
    i: usize,
    j: usize,
) -> Option<(usize, usize)> {
    let (Kind::LinkShapesSkips, Some(Elements::Skips(rows))) = (module, matrix.elements) else {
        return None;
    };
    let simple = context.document(Kind::LinkShapesSimpleSkips)?;
    let place = matrix.kind as usize;
    let before = match context.document(module)? {
        ModuleDocument::LinkShapesSkips(skips) => {
            let reason = of_pair(reasons(simple)?[place]?, i, j)?;
            let mut skipped = skips.skipped_reasons.iter();
            skipped.any(|skipped| skipped.of_pair() == reason)
        }
        _ => of_pair(skips(simple)?[place]?, i, j)?,
    };
    if at(rows, i, j)? == before { Some((j, i)) } else { Some((i, j)) }
}
