use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::fold::Fold;
use crate::rule::declare_rule;
use crate::views::shape_pair::Pairs;
use urdd_document::shape_matrices::statistics;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;

declare_rule! {
    /// A mean distance does not lie between the smallest and the largest.
    ///
    /// The three are taken over the same sampled configurations, so the mean is between the other
    /// two, apart from rounding. Where it is not, one of them is of other samples, of another
    /// pair, or in the wrong matrix.
    ///
    /// Compute all three again in one run.
    SHP008 "statistics-out-of-order", Error, clause "8.5", since "0.1.0",
    phase References, needs [Module(Kind::LinkShapesDistanceStatistics), NotFailed(SHP005)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesDistanceStatistics;
    let Some(module) = context.module(kind) else {
        return;
    };
    let six = context.document(kind).and_then(statistics);
    for (kind, one) in ShapeKind::ALL.into_iter().zip(six.into_iter().flatten()) {
        let Some(one) = one else {
            continue;
        };
        let [mean_key, ..] = one.keys;
        let pairs = Pairs::new(&one);
        let mut fold = Fold::new(findings);
        for i in 0..one.mean.len() {
            for j in i + 1..one.mean.len() {
                // Pairs of two minds and negative distances are other rules' business.
                let Some(pair) = pairs.read(i, j) else {
                    continue;
                };
                if pair.in_order() {
                    continue;
                }
                fold.add(|| {
                    Finding::at(
                        module.file("module.json"),
                        format!("/{}/{mean_key}/{i}/{j}", kind.key()),
                        "the mean distance lies outside the smallest and the largest",
                    )
                    .expected(format!("from {} to {}", pair.min, pair.max))
                    .actual(pair.mean)
                    .tolerance(pair.tolerance)
                });
            }
        }
        fold.finish();
    }
}
