use crate::rules::prelude::*;

declare_rule! {
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
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
            let Some(pair) = pair.filter(|pair| !pair.is_constant(tolerance)) else {
                continue;
            };
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
