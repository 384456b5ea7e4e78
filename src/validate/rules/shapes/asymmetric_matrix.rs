use crate::document::shape_matrices::{Elements, MATRIX_MODULES, matrices};
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::fold::Fold;
use crate::validate::rule::declare_rule;
use crate::validate::tolerance::NUMBER_RELATIVE;
use crate::validate::views::tangled::symmetric_at;

declare_rule! {
    /// A matrix over shapes is not symmetric: a pair has one value one way round and another the other.
    ///
    /// The distance of A to B is that of B to A, and a check that is skipped between A and B is skipped
    /// between B and A. With an asymmetric skip matrix, whether a collision is seen depends on the order
    /// in which a program happens to name the pair. Most often one of two elements was edited by hand.
    ///
    /// Set both elements of each pair.
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
