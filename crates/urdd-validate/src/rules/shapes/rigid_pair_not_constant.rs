use crate::context::Context;
use crate::distances::tolerances::Tolerances;
use crate::finding::{Finding, Findings};
use crate::fold::Fold;
use crate::rule::declare_rule;
use crate::views::shape_pair::{Pair, Pairs};
use urdd_document::shape_matrices::statistics;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;

declare_rule! {
    /// The distance of two shapes that fixed joints hold together is not the same at all times.
    ///
    /// Shapes of one link, and of links that only fixed joints are between, never move against each
    /// other: their mean, smallest and largest distance are one number. Where they are not, the numbers
    /// are those of another pair, or the robot was driven with a joint that is fixed.
    ///
    /// Compute the statistics again. Look at the order of shapes in the matrices first.
    SHP022 "rigid-pair-not-constant", Error, clause "8.5", since "0.1.0",
    phase Statistics, needs [
        Module(Kind::Urdf),
        Module(Kind::LinkShapesDistanceStatistics),
        Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes),
        NotFailed(URD004),
        NotFailed(URD006),
        PIECES_LISTED,
        Passed(SHP005),
        NotFailed(SHP010),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesDistanceStatistics;
    let (Some(module), Some(six), Some(shapes), Some(groups)) = (
        context.module(kind),
        context.document(kind).and_then(statistics),
        context.shapes(),
        context.rigid_groups(),
    ) else {
        return;
    };
    for (kind, one) in ShapeKind::ALL.into_iter().zip(six) {
        let Some(one) = one else {
            continue;
        };
        let [_, min_key, _] = one.keys;
        let pairs = Pairs::new(&one);
        let tolerances = Tolerances::new(context, context.solids(), &shapes, kind);
        let group = |shape: usize| groups.of_link.get(shapes.link(kind, shape)?);
        let mut fold = Fold::new(findings);
        for i in 0..one.min.len() {
            for j in i + 1..one.min.len() {
                if group(i).is_none() || group(i) != group(j) {
                    continue;
                }
                let tolerance = tolerances.pair(i, j);
                // What is out of order is SHP008's.
                let Some(pair) = pairs.read(i, j).filter(Pair::in_order) else {
                    continue;
                };
                if pair.is_constant(tolerance) {
                    continue;
                }
                fold.add(|| {
                    Finding::at(
                        module.file("module.json"),
                        format!("/{}/{min_key}/{i}/{j}", kind.key()),
                        format!(
                            "shapes {} and {} do not move against each other, and have more than one distance",
                            shapes.describe(context, kind, i),
                            shapes.describe(context, kind, j)
                        ),
                    )
                    .expected("smallest = mean = largest")
                    .actual(format!("{}, {}, {}", pair.min, pair.mean, pair.max))
                    .tolerance(tolerance)
                    .off_by(pair.max - pair.min, "m")
                });
            }
        }
        fold.finish();
    }
}
