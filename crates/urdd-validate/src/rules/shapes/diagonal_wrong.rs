use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::views::tangled::{Tangled, diagonal_sound};
use urdd_document::shape_matrices::{Elements, MATRIX_MODULES, matrices};

declare_rule! {
    /// A shape has a distance to itself, or is not to be skipped against itself.
    ///
    /// A shape is always in contact with itself: on the diagonal, distances are 0 and skips true. Where
    /// they are not, a program that runs over all pairs reports a robot in collision with itself for ever.
    ///
    /// Write 0, or true, on the diagonal.
    SHP007 "diagonal-wrong", Error, clause "8.4", since "0.1.0",
    phase References, needs [
        AnyModule(&[
            Kind::LinkShapesDistanceStatistics,
            Kind::LinkShapesSimpleSkips,
            Kind::LinkShapesSkips,
        ]),
        NotFailed(SHP005),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    for kind in MATRIX_MODULES {
        let (Some(document), Some(module)) = (context.document(*kind), context.module(*kind))
        else {
            continue;
        };
        for matrix in matrices(document) {
            let Some(elements) = matrix.elements else {
                continue;
            };
            let tangled = Tangled::new(elements);
            for i in 0..elements.rows() {
                // Where the row of the shape is wrong beyond that, SHP006 says so.
                if diagonal_sound(elements, i) || tangled.asymmetric(i) {
                    continue;
                }
                let expected = match elements {
                    Elements::Distances(_) => "0",
                    _ => "true",
                };
                findings.report(
                    Finding::at(
                        module.file("module.json"),
                        format!("{}/{i}/{i}", matrix.pointer),
                        format!("this is the element of shape {i} and itself, which is always {expected}"),
                    )
                    .expected(expected)
                    .actual(elements.text(i, i)),
                );
            }
        }
    }
}
