//! The statistics of distances, by themselves and computed again.

use crate::rules::prelude::*;
use crate::views::judged::JudgedShapes;
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

    /// In one of the sampled configurations two shapes are at a distance that the statistics rule out.
    ///
    /// The smallest and the largest distance are over the first `num_samples` sampled configurations, so
    /// that in each of these every distance lies between them. By the smallest, programs leave pairs out
    /// that never come near each other: where it is too large, they miss collisions.
    ///
    /// Of matrices that would take too long to compute again, the first configurations are looked at;
    /// `--deep` computes all of them (SHP024). Compute the statistics again, from the shapes as they are
    /// now and the configurations of SPEC 9.3. Poses are golden in `kinematics_samples_module`.
    SHP023 "distance-out-of-range", Error, clause "8.5", since "0.1.0",
    phase Statistics, needs [Version1, STATISTICS], check distance_out_of_range,

    /// The mean, smallest or largest distance of two shapes is not that of the sampled configurations.
    ///
    /// The configurations are defined, so that the numbers can be computed again, and they were. Skips
    /// follow from them, and by them programs decide in which order pairs are tested.
    ///
    /// Matrices that would take too long are left to `--deep`, and looked at in the first configurations
    /// only (SHP023). Where all pairs differ, look at `num_samples`, at the formulas of SPEC 9.3, and at the
    /// poses in `kinematics_samples_module`; where those of one shape do, at its mesh, box or sphere. Where
    /// single pairs do, look at the distance library: python-fcl 0.7 is centimetres off on symmetric
    /// poses, coal is not. The message names a configuration to compute by hand.
    SHP024 "statistics-differ", Error, clause "8.5", since "0.1.0",
    phase Statistics, needs [Version1, STATISTICS], check statistics_differ,
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

fn distance_out_of_range(context: &Context, findings: &mut Findings) -> Option<()> {
    let six = context.statistics()?;
    let shapes = context.shapes()?;
    let distances = findings.or_skip(context.distances())?;
    for ((kind, one), found) in ShapeKind::ALL.into_iter().zip(six).zip(&distances.kinds) {
        // SHP024 judges what was recomputed completely.
        let (Some(one), Some(found)) = (one, found.as_ref().filter(|found| !found.complete)) else {
            continue;
        };
        let [_, min_key, max_key] = one.keys;
        let stated = Pairs::new(&one);
        let tolerances = Tolerances::new(context, context.solids(), &shapes, kind);
        let judged = JudgedShapes::new(context, findings, &shapes, kind);
        let mut fold = Fold::new(findings);
        for (i, j) in pairs(one.min.len()).filter(|(i, j)| judged.pair(*i, *j)) {
            let pair = stated.read(i, j).filter(Pair::in_order);
            let Some((pair, range)) = pair.zip(found.pair(i, j)) else { continue };
            let tolerance = tolerances.pair(i, j);
            let (low, high) = (pair.min - tolerance, pair.max + tolerance);
            let key = match () {
                () if range.min < low => min_key,
                () if range.max > high => max_key,
                () => continue,
            };
            fold.add(|| {
                let outside = |distance: f64| distance < low || distance > high;
                let at = distances.find(found, (i, j), outside);
                let (sample, distance) = at.unwrap_or((0, range.min));
                let [a, b] = [i, j].map(|shape| shapes.describe(context, kind, shape));
                let pointer = format!("/{}/{key}/{i}/{j}", kind.key());
                let message = format!(
                    "in sampled configuration {sample} the distance of shapes {a} and {b} is outside of the stated range"
                );
                finding_in(Kind::LinkShapesDistanceStatistics, pointer, message)
                    .expected(format!("a range that contains {distance}"))
                    .actual(format!("from {} to {}", pair.min, pair.max))
                    .tolerance(tolerance)
                    .off_by((pair.min - distance).max(distance - pair.max), "m")
            });
        }
    }
    Some(())
}

fn statistics_differ(context: &Context, findings: &mut Findings) -> Option<()> {
    let six = context.statistics()?;
    let shapes = context.shapes()?;
    let groups = context.rigid_groups()?;
    let distances = findings.or_skip(context.distances())?;
    let mut left = Vec::new();
    for ((kind, one), found) in ShapeKind::ALL.into_iter().zip(six).zip(&distances.kinds) {
        let (Some(one), Some(found)) = (one, found) else { continue };
        if !found.complete {
            left.push(kind.key());
            continue;
        }
        let stated = Pairs::new(&one);
        let tolerances = Tolerances::new(context, context.solids(), &shapes, kind);
        let group = |shape: usize| groups.of_link.get(shapes.link(kind, shape)?);
        let judged = JudgedShapes::new(context, findings, &shapes, kind);
        let mut fold = Fold::new(findings);
        for (i, j) in pairs(one.min.len()).filter(|(i, j)| judged.pair(*i, *j)) {
            let pair = stated.read(i, j).filter(Pair::in_order);
            let Some((pair, right)) = pair.zip(found.pair(i, j)) else { continue };
            let tolerance = tolerances.pair(i, j);
            // SHP022 reports a distance that should be constant and is not.
            if group(i) == group(j) && !pair.is_constant(tolerance) {
                continue;
            }
            let three = [(pair.mean, right.mean), (pair.min, right.min), (pair.max, right.max)];
            let mut keyed = one.keys.into_iter().zip(three);
            let differs = |(actual, expected): (f64, f64)| (actual - expected).abs() > tolerance;
            let Some((key, (actual, expected))) = keyed.find(|(_, pair)| differs(*pair)) else {
                continue;
            };
            fold.add(|| {
                let (extreme, stated, which) = match key == one.keys[2] {
                    false => (right.min, pair.min, "nearest"),
                    true => (right.max, pair.max, "farthest"),
                };
                // A pair on its own and all pairs together may round differently.
                let is_extreme = |distance: f64| (distance - extreme).abs() <= 1e-9;
                let at = distances.find(found, (i, j), is_extreme);
                let (extreme, stated) = (number(extreme, 9), number(stated, 9));
                let which = at.map_or(String::new(), |(sample, _)| {
                    format!(
                        "; they are {which} in sampled configuration {sample}: {extreme} m, and {stated} m is stated"
                    )
                });
                let [a, b] = [i, j].map(|shape| shapes.describe(context, kind, shape));
                let pointer = format!("/{}/{key}/{i}/{j}", kind.key());
                let message = format!(
                    "for shapes {a} and {b} this is not what the sampled configurations give{which}"
                );
                finding_in(Kind::LinkShapesDistanceStatistics, pointer, message)
                    .values(expected, actual)
                    .tolerance(tolerance)
                    .off_by(actual - expected, "m")
            });
        }
    }
    if findings.is_empty() && !left.is_empty() {
        return findings.skip(skip::not_deep(&left));
    }
    Some(())
}
