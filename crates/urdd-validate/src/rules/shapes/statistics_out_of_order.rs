use crate::rules::prelude::*;

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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for (kind, one) in by_kind(context.statistics()?) {
        let [mean_key, ..] = one.keys;
        let stated = Pairs::new(&one);
        let mut fold = Fold::new(findings);
        for (i, j) in pairs(one.mean.len()) {
            // Other rules report asymmetric and negative distances.
            let pair = stated.read(i, j).filter(|pair| !pair.in_order());
            if let Some(pair) = pair {
                fold.add(|| {
                    let pointer = format!("/{}/{mean_key}/{i}/{j}", kind.key());
                    let message = "the mean distance is not between the smallest and the largest";
                    finding_in(Kind::LinkShapesDistanceStatistics, pointer, message)
                        .values(format!("from {} to {}", pair.min, pair.max), pair.mean)
                        .tolerance(pair.tolerance)
                });
            }
        }
    }
    Some(())
}
