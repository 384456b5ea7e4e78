use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::fold::Fold;
use crate::rule::declare_rule;
use urdd_document::shape_matrices::{at, statistics};
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;

declare_rule! {
    /// A distance between two shapes is negative.
    ///
    /// How deep two shapes penetrate each other differs from one library to the next, so the distance of
    /// shapes that touch or overlap is 0 here. (Legacy modules hold such depths, as negative distances.)
    ///
    /// Write 0 for every sample in contact, and take mean, smallest and largest over these.
    SHP009 "negative-distance", Error, clause "8.5", since "0.1.0",
    phase References, needs [
        Version1,
        Module(Kind::LinkShapesDistanceStatistics),
        NotFailed(SHP005),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesDistanceStatistics;
    let Some(module) = context.module(kind) else {
        return;
    };
    let six = context.document(kind).and_then(statistics);
    for (kind, one) in ShapeKind::ALL.into_iter().zip(six.into_iter().flatten()) {
        // Those of a legacy module may be negative.
        let Some(one) = one.filter(|one| one.num_samples.is_some()) else {
            continue;
        };
        for (key, rows) in one.keys.into_iter().zip([one.mean, one.min, one.max]) {
            let mut fold = Fold::new(findings);
            for i in 0..rows.len() {
                for j in i + 1..rows.len() {
                    // Where only one of the two is, SHP006 says that they differ.
                    let (Some(one), Some(two)) = (at(rows, i, j), at(rows, j, i)) else {
                        continue;
                    };
                    if one < 0.0 && two < 0.0 {
                        fold.add(|| {
                            Finding::at(
                                module.file("module.json"),
                                format!("/{}/{key}/{i}/{j}", kind.key()),
                                "a distance is never negative: it is 0 in contact",
                            )
                            .expected("0 or more")
                            .actual(one)
                        });
                    }
                }
            }
            fold.finish();
        }
    }
}
