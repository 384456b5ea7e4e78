use crate::rules::prelude::*;
use urdd_document::shape_matrices::at;

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
    check statistics_out_of_order,

    /// A distance between two shapes is negative.
    ///
    /// How deep two shapes penetrate each other differs from one library to the next, so the distance of
    /// shapes that touch or overlap is 0 here. (Legacy modules hold such depths, as negative distances.)
    ///
    /// Write 0 for every sample in contact, and take mean, smallest and largest over these.
    SHP009 "negative-distance", Error, clause "8.5", since "0.1.0",
    phase References, needs [Version1, Module(Kind::LinkShapesDistanceStatistics), NotFailed(SHP005)],
    check negative_distance,

    /// The distance statistics are said to be of no samples.
    ///
    /// `num_samples` is the number of sampled configurations that the distances were taken over;
    /// without any there is no mean, smallest or largest distance.
    ///
    /// Write the number of configurations that were sampled, at least 1.
    SHP016 "no-samples", Error, clause "8.5", since "0.1.0",
    phase References, consequence Format, needs [Version1, ModuleV1(Kind::LinkShapesDistanceStatistics)],
    check no_samples,

    /// The distance of two shapes that fixed joints hold together is not the same at all times.
    ///
    /// Shapes of one link, and of links with only fixed joints between them, never move relative to
    /// each other: their mean, smallest and largest distance are one number. Where they are not, the
    /// numbers are those of another pair, or the robot was driven with a joint that is fixed.
    ///
    /// Compute the statistics again. Look at the order of shapes in the matrices first.
    SHP022 "rigid-pair-not-constant", Error, clause "8.5", since "0.1.0",
    phase Statistics, needs [
        Module(Kind::Urdf), Module(Kind::LinkShapesDistanceStatistics), Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes), ROBOT_SOUND, PIECES_LISTED, Passed(SHP005), NotFailed(SHP010),
    ], check rigid_pair_not_constant,
}

fn statistics_out_of_order(context: &Context, findings: &mut Findings) -> Option<()> {
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

fn negative_distance(context: &Context, findings: &mut Findings) -> Option<()> {
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

fn no_samples(context: &Context, findings: &mut Findings) -> Option<()> {
    let statistics = document!(context, LinkShapesDistanceStatistics)?;
    if statistics.num_samples.get() == 0 {
        let message = "distances are taken over at least one sampled configuration";
        finding_in(Kind::LinkShapesDistanceStatistics, "/num_samples", message)
            .values("1 or more", 0)
            .report(findings);
    }
    Some(())
}

fn rigid_pair_not_constant(context: &Context, findings: &mut Findings) -> Option<()> {
    let shapes = context.shapes()?;
    let groups = context.rigid_groups()?;
    for (kind, one) in by_kind(context.statistics()?) {
        let [_, min_key, _] = one.keys;
        let stated = Pairs::new(&one);
        let tolerances = Tolerances::new(context, context.solids(), &shapes, kind);
        let group = |shape: usize| groups.of_link.get(shapes.link(kind, shape)?);
        let mut fold = Fold::new(findings);
        for (i, j) in pairs(one.min.len()) {
            if group(i).is_none() || group(i) != group(j) {
                continue;
            }
            let tolerance = tolerances.pair(i, j);
            // SHP008 reports distances that are out of order.
            let pair = stated.read(i, j).filter(Pair::in_order);
            let Some(pair) = pair.filter(|pair| !pair.is_constant(tolerance)) else { continue };
            fold.add(|| {
                let [a, b] = [i, j].map(|shape| shapes.describe(context, kind, shape));
                let pointer = format!("/{}/{min_key}/{i}/{j}", kind.key());
                let message = format!(
                    "shapes {a} and {b} do not move relative to each other, but have more than one distance"
                );
                finding_in(Kind::LinkShapesDistanceStatistics, pointer, message)
                    .expected("smallest = mean = largest")
                    .actual(format!("{}, {}, {}", pair.min, pair.mean, pair.max))
                    .tolerance(tolerance)
                    .off_by(pair.max - pair.min, "m")
            });
        }
    }
    Some(())
}
