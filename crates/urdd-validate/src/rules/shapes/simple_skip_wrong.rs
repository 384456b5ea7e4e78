use crate::rules::prelude::*;
use crate::views::tangled::sound_pairs;
use urdd_document::shape_matrices::{Elements, skips, skips_pointer};

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
        Module(Kind::LinkShapesDistanceStatistics), Module(Kind::LinkShapesSimpleSkips), Passed(SHP005),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesSimpleSkips;
    let document = context.document(kind)?;
    let shapes = context.shapes()?;
    let six = context.statistics()?.into_iter().zip(skips(document)?);
    for (kind, (statistics, rows)) in ShapeKind::ALL.into_iter().zip(six) {
        let Some(rows) = rows else {
            continue;
        };
        let stated = statistics.as_ref().map(Pairs::new);
        let mut fold = Fold::new(findings);
        for (i, j, skip) in sound_pairs(rows, Elements::Skips) {
            let same_link = shapes.link(kind, i) == shapes.link(kind, j);
            let pair = stated.as_ref().and_then(|stated| stated.read(i, j));
            let expected = match same_link {
                true => Some(true),
                false => pair.filter(Pair::in_order).as_ref().and_then(Pair::always),
            };
            if expected.is_none_or(|expected| expected == skip) {
                continue;
            }
            fold.add(|| {
                let why = match (same_link, pair) {
                    (false, Some(pair)) => {
                        format!("their largest sampled distance is {}", metres(pair.max))
                    }
                    _ => "both are on one link".to_owned(),
                };
                let [a, b] = [i, j].map(|shape| shapes.describe(context, kind, shape));
                let not = if skip { "not " } else { "" };
                let pointer = format!("{}/{i}/{j}", skips_pointer(document, kind));
                let message = format!("shapes {a} and {b} are {not}to be skipped: {why}");
                finding_in(Kind::LinkShapesSimpleSkips, pointer, message).values(!skip, skip)
            });
        }
    }
    Some(())
}
