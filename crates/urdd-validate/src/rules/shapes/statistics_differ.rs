use crate::context::Context;
use crate::distances::tolerances::Tolerances;
use crate::finding::{Finding, Findings};
use crate::fold::Fold;
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use crate::views::judged;
use crate::views::shape_pair::{Pair, Pairs};
use urdd_document::shape_matrices::statistics;
use urdd_format::readable::number;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;

declare_rule! {
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
    let (Some(module), Some(six), Some(shapes), Some(groups)) = (
        context.module(kind),
        context.document(kind).and_then(statistics),
        context.shapes(),
        context.rigid_groups(),
    ) else {
        return;
    };
    let distances = match context.distances() {
        Ok(distances) => distances,
        Err(reason) => return findings.skip(reason.clone()),
    };
    let mut left = Vec::new();
    for ((kind, one), found) in ShapeKind::ALL.into_iter().zip(six).zip(distances.kinds()) {
        let (Some(one), Some(found)) = (one, found) else {
            continue;
        };
        if !found.complete {
            left.push(kind.key());
            continue;
        }
        let pairs = Pairs::new(&one);
        let tolerances = Tolerances::new(context, context.solids(), &shapes, kind);
        let group = |shape: usize| groups.of_link.get(shapes.link(kind, shape)?);
        let judged = judged::shapes(context, findings, &shapes, kind);
        let judged = |shape: usize| judged.get(shape).copied().unwrap_or(true);
        let mut fold = Fold::new(findings);
        for i in 0..one.min.len() {
            for j in i + 1..one.min.len() {
                let pair = pairs.read(i, j).filter(Pair::in_order);
                let pair = pair.filter(|_| judged(i) && judged(j));
                let (Some(pair), Some(right)) = (pair, found.pair(i, j)) else {
                    continue;
                };
                let tolerance = tolerances.pair(i, j);
                // What should be constant, and is not, SHP022 tells.
                if group(i) == group(j) && !pair.is_constant(tolerance) {
                    continue;
                }
                let three = [
                    (pair.mean, right.mean),
                    (pair.min, right.min),
                    (pair.max, right.max),
                ];
                let mut keyed = one.keys.into_iter().zip(three);
                let differs =
                    |(actual, expected): (f64, f64)| (actual - expected).abs() > tolerance;
                let Some((key, (actual, expected))) = keyed.find(|(_, pair)| differs(*pair)) else {
                    continue;
                };
                fold.add(|| {
                    let nearest = key != one.keys[2];
                    let (extreme, stated) = match nearest {
                        true => (right.min, pair.min),
                        false => (right.max, pair.max),
                    };
                    // One pair and all pairs may round otherwise.
                    let is_extreme = |distance: f64| (distance - extreme).abs() <= 1e-9;
                    let at = distances.find(found, (i, j), is_extreme);
                    let which = match at {
                        Some((sample, _)) => format!(
                            "; they are {} in sampled configuration {sample}: {} m, and {} m is stated",
                            if nearest { "nearest" } else { "farthest" },
                            number(extreme, 9),
                            number(stated, 9)
                        ),
                        None => String::new(),
                    };
                    Finding::at(
                        module.file("module.json"),
                        format!("/{}/{key}/{i}/{j}", kind.key()),
                        format!(
                            "for shapes {} and {} this is not what the sampled configurations give{which}",
                            shapes.describe(context, kind, i),
                            shapes.describe(context, kind, j)
                        ),
                    )
                    .expected(expected)
                    .actual(actual)
                    .tolerance(tolerance)
                    .off_by(actual - expected, "m")
                });
            }
        }
        fold.finish();
    }
    if findings.is_empty() && !left.is_empty() {
        findings.skip(SkipReason::NotDeep(left));
    }
}
