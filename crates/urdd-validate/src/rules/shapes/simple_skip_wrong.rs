use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::fold::Fold;
use crate::rule::declare_rule;
use crate::views::shape_pair::{Pair, Pairs};
use crate::views::tangled::Tangled;
use urdd_document::shape_matrices::{Elements, at, skips, skips_pointer, statistics};
use urdd_format::readable::metres;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;

declare_rule! {
    /// A simple skip is not what the distance statistics say.
    ///
    /// A pair is skipped when both shapes are on one link, or when they are always in contact: their
    /// largest sampled distance is at most 0.001 m. A skip too many hides collisions; one too few makes
    /// a program report a collision that is there in every configuration. Most often one of the two
    /// modules is stale.
    ///
    /// Write the simple skips again from the statistics, or both again.
    SHP011 "simple-skip-wrong", Error, clause "8.6", since "0.1.0",
    phase References, needs [
        Module(Kind::LinkShapesDistanceStatistics),
        Module(Kind::LinkShapesSimpleSkips),
        Passed(SHP005),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesSimpleSkips;
    let (Some(document), Some(module), Some(shapes)) = (
        context.document(kind),
        context.module(kind),
        context.shapes(),
    ) else {
        return;
    };
    let six = context
        .document(ModuleKind::LinkShapesDistanceStatistics)
        .and_then(statistics);
    let (Some(six), Some(skips)) = (six, skips(document)) else {
        return;
    };
    for ((kind, statistics), rows) in ShapeKind::ALL.into_iter().zip(six).zip(skips) {
        let Some(rows) = rows else {
            continue;
        };
        let tangled = Tangled::new(Elements::Skips(rows));
        let pairs = statistics.as_ref().map(Pairs::new);
        let mut fold = Fold::new(findings);
        for i in 0..rows.len() {
            for j in i + 1..rows.len() {
                // A pair whose two elements differ is SHP006's.
                let (Some(skip), Some(mirror)) = (at(rows, i, j), at(rows, j, i)) else {
                    continue;
                };
                let same_link = shapes.link(kind, i) == shapes.link(kind, j);
                let pair = pairs.as_ref().and_then(|pairs| pairs.read(i, j));
                let sound = pair.filter(Pair::in_order);
                let expected = match same_link {
                    true => Some(true),
                    false => sound.as_ref().and_then(Pair::always),
                };
                let right = expected.is_none_or(|expected| expected == skip);
                if skip != mirror || right || tangled.pair(i, j) {
                    continue;
                }
                fold.add(|| {
                    let why = match (same_link, pair) {
                        (false, Some(pair)) => {
                            format!("their largest sampled distance is {}", metres(pair.max))
                        }
                        _ => "both are on one link".to_owned(),
                    };
                    Finding::at(
                        module.file("module.json"),
                        format!("{}/{i}/{j}", skips_pointer(document, kind)),
                        format!(
                            "shapes {} and {} are {}to be skipped: {why}",
                            shapes.describe(context, kind, i),
                            shapes.describe(context, kind, j),
                            if skip { "not " } else { "" },
                        ),
                    )
                    .expected(!skip)
                    .actual(skip)
                });
            }
        }
        fold.finish();
    }
}
