use crate::rules::prelude::*;
use crate::views::tangled::{Tangled, of_pair};
use urdd_document::shape_matrices::{Elements, at, reasons, skips};
use urdd_format::link_shapes_simple_skips::SkipReason;

declare_rule! {
    /// The reason given for a pair of shapes is not the first that applies.
    ///
    /// The reasons, in their order: `SameLink`; `Always` in contact (largest sampled distance at most
    /// 0.001 m); `Adjacent`, connected by a joint; `Default`, in contact in the default configuration;
    /// `Never` in contact (smallest distance more than 0.001 m); `None` of these. Which pairs a collision
    /// check skips follows from them.
    ///
    /// Write the reasons again from `chain_module` and the distance statistics. (`Default` is held to the
    /// meshes: SHP026.)
    SHP012 "skip-reason-wrong", Error, clause "8.6", since "0.1.0",
    phase References, needs [
        Version1, Module(Kind::Chain), Module(Kind::LinkShapesDistanceStatistics),
        ModuleV1(Kind::LinkShapesSimpleSkips), NotFailed(CHN002), Passed(SHP005),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesSimpleSkips;
    let document = context.document(kind)?;
    let shapes = context.shapes()?;
    let joints = context.chain()?.joints_in_chain.iter();
    let joined: HashSet<(usize, usize)> = joints
        .map(|joint| ordered(joint.parent_link_idx.get(), joint.child_link_idx.get()))
        .collect();
    let (six, skips, reasons) = (context.statistics()?, skips(document)?, reasons(document)?);
    for (((kind, statistics), skips), rows) in
        ShapeKind::ALL.into_iter().zip(six).zip(skips).zip(reasons)
    {
        let Some(rows) = rows else {
            continue;
        };
        let tangled = Tangled::new(Elements::Reasons(rows));
        let stated = statistics.as_ref().map(Pairs::new);
        let mut fold = Fold::new(findings);
        for (i, j) in (0..rows.len()).flat_map(|i| (i..rows.len()).map(move |j| (i, j))) {
            let links = shapes.link(kind, i).zip(shapes.link(kind, j));
            // SHP006 reports a pair whose two elements differ.
            let (Some(reason), Some((a, b))) = (of_pair(rows, i, j), links) else {
                continue;
            };
            let pair = stated.as_ref().and_then(|stated| stated.read(i, j));
            let expected = match (a == b, pair.filter(Pair::in_order)) {
                (true, _) => Some(SkipReason::SameLink),
                (false, Some(pair)) => first_reason(&pair, joined.contains(&ordered(a, b))),
                (false, None) => None,
            };
            let Some(expected) = expected else {
                continue;
            };
            // SHP026 judges whether the pair is in contact in the default configuration.
            let after_default = matches!(expected, SkipReason::Never | SkipReason::None);
            if reason == SkipReason::Default && after_default {
                continue;
            }
            // SHP011 reports a wrong skip.
            let skipped = matches!(expected, SkipReason::SameLink | SkipReason::Always);
            let skip = skips.and_then(|skips| at(skips, i, j)).unwrap_or(skipped);
            if tangled.pair(i, j) || reason == expected || (i != j && skip != skipped) {
                continue;
            }
            fold.add(|| {
                let [a, b] = [i, j].map(|shape| shapes.describe(context, kind, shape));
                let pointer = format!("/reasons/{}/{i}/{j}", kind.key());
                let message =
                    format!("for shapes {a} and {b} this is not the first reason that applies");
                finding_in(Kind::LinkShapesSimpleSkips, pointer, message).literals(expected, reason)
            });
        }
    }
    Some(())
}

/// The first reason that applies to shapes of two links; `None` if that depends on rounding.
fn first_reason(pair: &Pair, adjacent: bool) -> Option<SkipReason> {
    if pair.always()? {
        return Some(SkipReason::Always);
    }
    if adjacent {
        return Some(SkipReason::Adjacent);
    }
    Some(if pair.never()? { SkipReason::Never } else { SkipReason::None })
}

fn ordered(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}
