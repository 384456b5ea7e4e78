use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::fold::Fold;
use crate::rule::declare_rule;
use crate::tolerance::NUMBER_RELATIVE;
use crate::views::tangled::symmetric_at;
use urdd_document::shape_matrices::{
    Elements, MATRIX_MODULES, Matrix, Rows, at, matrices, reasons, skips,
};
use urdd_format::registry::{ModuleDocument, ModuleKind};

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
    phase References, needs [
        AnyModule(&[
            Kind::LinkShapesDistanceStatistics,
            Kind::LinkShapesSimpleSkips,
            Kind::LinkShapesSkips,
            Kind::LinkShapesLieAlgErrorModels,
        ]),
        NotFailed(SHP005),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let shapes = context.shapes();
    for kind in MATRIX_MODULES {
        let (Some(document), Some(module)) = (context.document(*kind), context.module(*kind))
        else {
            continue;
        };
        for matrix in matrices(document) {
            let Some(elements) = matrix.elements else {
                continue;
            };
            let name = |shape: usize| match &shapes {
                Some(shapes) => shapes.describe(context, matrix.kind, shape),
                None => shape.to_string(),
            };
            let mut fold = Fold::new(findings);
            for i in 0..elements.rows() {
                for j in i + 1..elements.rows() {
                    if symmetric_at(elements, i, j) {
                        continue;
                    }
                    if let Some(edited) = edited_half(context, *kind, &matrix, i, j) {
                        fold.add(|| {
                            let (a, b) = edited;
                            let mirror = format!("{}/{b}/{a}", matrix.pointer);
                            Finding::at(
                                module.file("module.json"),
                                format!("{}/{a}/{b}", matrix.pointer),
                                format!(
                                    "shapes {} and {} are skipped one way round only: this half is an edit, \
                                     {mirror} is what the simple skips give; set both to the edit, or both back",
                                    name(a),
                                    name(b)
                                ),
                            )
                            .expected(format!("the same as at {mirror}"))
                            .actual(format!(
                                "{}, and {} there",
                                elements.text(a, b),
                                elements.text(b, a)
                            ))
                        });
                        continue;
                    }
                    fold.add(|| {
                        let finding = Finding::at(
                            module.file("module.json"),
                            format!("{}/{i}/{j}", matrix.pointer),
                            format!(
                                "shapes {} and {} have one value one way round and another the other way: set both",
                                name(i),
                                name(j)
                            ),
                        )
                        .expected(format!(
                            "{}, as at {}/{j}/{i}",
                            elements.text(j, i),
                            matrix.pointer
                        ))
                        .actual(elements.text(i, j));
                        match elements {
                            Elements::Distances(_) | Elements::Models(_) => {
                                finding.tolerance(NUMBER_RELATIVE)
                            }
                            Elements::Skips(_) | Elements::Reasons(_) => finding,
                        }
                    });
                }
            }
            fold.finish();
        }
    }
}

/// Of two elements of a skip matrix that differ, the place of the one that is not as it was before a
/// person's edits; `None` in other modules, and where nothing says what it was.
fn edited_half(
    context: &Context,
    module: ModuleKind,
    matrix: &Matrix,
    i: usize,
    j: usize,
) -> Option<(usize, usize)> {
    let (ModuleKind::LinkShapesSkips, Some(Elements::Skips(rows))) = (module, matrix.elements)
    else {
        return None;
    };
    let simple = context.document(ModuleKind::LinkShapesSimpleSkips)?;
    let place = matrix.kind as usize;
    let before = match context.document(module)? {
        ModuleDocument::LinkShapesSkips(skips) => {
            let reason = same_both_ways(reasons(simple)?[place], i, j)?;
            let mut skipped = skips.skipped_reasons.iter();
            skipped.any(|skipped| skipped.of_pair() == reason)
        }
        _ => same_both_ways(skips(simple)?[place], i, j)?,
    };
    match at(rows, i, j)? == before {
        true => Some((j, i)),
        false => Some((i, j)),
    }
}

fn same_both_ways<T: Copy + PartialEq>(rows: Rows<T>, i: usize, j: usize) -> Option<T> {
    let (element, mirror) = (at(rows?, i, j)?, at(rows?, j, i)?);
    (element == mirror).then_some(element)
}
