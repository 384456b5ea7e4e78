use crate::rules::prelude::*;
use crate::views::judged::JudgedShapes;

declare_rule! {
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
