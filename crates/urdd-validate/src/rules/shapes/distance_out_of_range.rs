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
    phase Statistics, needs [Version1, STATISTICS],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
            let Some((pair, range)) = pair.zip(found.pair(i, j)) else {
                continue;
            };
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
