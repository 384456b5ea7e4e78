use crate::rules::prelude::*;
use crate::views::tangled::{of_pair, pairs, symmetric_at};
use urdd_document::shape_matrices::{
    Elements, MATRIX_MODULES, Matrix, at, matrices, reasons, skips,
};

declare_rule! {
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
    phase References, needs [SHAPE_MATRICES_OR_MODELS, NotFailed(SHP005)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
