use crate::context::Context;
use crate::distances::tolerances::Tolerances;
use crate::finding::{Finding, Findings};
use crate::fold::Fold;
use crate::rule::declare_rule;
use crate::views::judged;
use crate::views::shape_pair::{Pair, Pairs};
use urdd_document::shape_matrices::statistics;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;

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
    phase Statistics, needs [
        Version1,
        Module(Kind::Urdf),
        Module(Kind::Dof),
        Module(Kind::Chain),
        Module(Kind::Bounds),
        Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes),
        Module(Kind::LinkShapesApproximations),
        Module(Kind::LinkShapesDistanceStatistics),
        POSES_KNOWN, BOUNDS_SOUND,
        PIECES_LISTED, OWN_FILES, SOUND_SHAPES,
        SHAPES_LISTED, NotFailed(SHP003), Passed(SHP005), NotFailed(SHP010), NotFailed(SHP016),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesDistanceStatistics;
    let (Some(module), Some(six), Some(shapes)) = (
        context.module(kind),
        context.document(kind).and_then(statistics),
        context.shapes(),
    ) else {
        return;
    };
    let distances = match context.distances() {
        Ok(distances) => distances,
        Err(reason) => return findings.skip(reason.clone()),
    };
    for ((kind, one), found) in ShapeKind::ALL.into_iter().zip(six).zip(distances.kinds()) {
        // What was computed in full is SHP024's.
        let (Some(one), Some(found)) = (one, found.as_ref().filter(|found| !found.complete)) else {
            continue;
        };
        let [_, min_key, max_key] = one.keys;
        let pairs = Pairs::new(&one);
        let tolerances = Tolerances::new(context, context.solids(), &shapes, kind);
        let judged = judged::shapes(context, findings, &shapes, kind);
        let judged = |shape: usize| judged.get(shape).copied().unwrap_or(true);
        let mut fold = Fold::new(findings);
        for i in 0..one.min.len() {
            for j in i + 1..one.min.len() {
                let pair = pairs.read(i, j).filter(Pair::in_order);
                let pair = pair.filter(|_| judged(i) && judged(j));
                let (Some(pair), Some(range)) = (pair, found.pair(i, j)) else {
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
                    Finding::at(
                        module.file("module.json"),
                        format!("/{}/{key}/{i}/{j}", kind.key()),
                        format!(
                            "in sampled configuration {sample} the distance of shapes {} and {} is not within what is stated",
                            shapes.describe(context, kind, i),
                            shapes.describe(context, kind, j)
                        ),
                    )
                    .expected(format!("a range that has {distance} in it"))
                    .actual(format!("from {} to {}", pair.min, pair.max))
                    .tolerance(tolerance)
                    .off_by((pair.min - distance).max(distance - pair.max), "m")
                });
            }
        }
        fold.finish();
    }
}
