use crate::rules::prelude::*;
use urdd_document::shape_matrices::at;

declare_rule! {
    /// A distance between two shapes is negative.
    ///
    /// How deep two shapes penetrate each other differs from one library to the next, so the distance of
    /// shapes that touch or overlap is 0 here. (Legacy modules hold such depths, as negative distances.)
    ///
    /// Write 0 for every sample in contact, and take mean, smallest and largest over these.
    SHP009 "negative-distance", Error, clause "8.5", since "0.1.0",
    phase References, needs [Version1, Module(Kind::LinkShapesDistanceStatistics), NotFailed(SHP005)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for (kind, one) in by_kind(context.statistics()?) {
        // Distances of a legacy module may be negative.
        if one.num_samples.is_none() {
            continue;
        }
        for (key, rows) in one.keys.into_iter().zip([one.mean, one.min, one.max]) {
            let mut fold = Fold::new(findings);
            for (i, j) in pairs(rows.len()) {
                // If only one of the two is negative, SHP006 reports that they differ.
                if let (Some(one), Some(two)) = (at(rows, i, j), at(rows, j, i))
                    && one < 0.0
                    && two < 0.0
                {
                    fold.add(|| {
                        let pointer = format!("/{}/{key}/{i}/{j}", kind.key());
                        let message = "a distance is never negative: it is 0 in contact";
                        let finding =
                            finding_in(Kind::LinkShapesDistanceStatistics, pointer, message);
                        finding.values("0 or more", one)
                    });
                }
            }
        }
    }
    Some(())
}
