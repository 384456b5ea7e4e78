use crate::rules::prelude::*;
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
    phase References, needs [SHAPE_MATRICES, NotFailed(SHP005)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for (_, module, document) in context.documents(MATRIX_MODULES) {
        for matrix in matrices(document) {
            let Some(elements) = matrix.elements else {
                continue;
            };
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
