use std::collections::HashSet;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::fold::Fold;
use crate::rule::declare_rule;
use crate::views::shape_pair::{Pair, Pairs};
use crate::views::tangled::Tangled;
use urdd_document::shape_matrices::{Elements, at, reasons, skips, statistics};
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;

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
        Version1,
        Module(Kind::Chain),
        Module(Kind::LinkShapesDistanceStatistics),
        Module(Kind::LinkShapesSimpleSkips),
        NotFailed(CHN002),
        Passed(SHP005),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesSimpleSkips;
    let (Some(document), Some(module), Some(shapes), Some(chain)) = (
        context.document(kind),
        context.module(kind),
        context.shapes(),
        context.chain(),
    ) else {
        return;
    };
    let six = context
        .document(ModuleKind::LinkShapesDistanceStatistics)
        .and_then(statistics);
    let (Some(six), Some(skips), Some(reasons)) = (six, skips(document), reasons(document)) else {
        return;
    };
    let joined: HashSet<(usize, usize)> = chain
        .joints
        .iter()
        .map(|joint| ordered(joint.parent_link_idx.get(), joint.child_link_idx.get()))
        .collect();
    for (((kind, statistics), skips), rows) in
        ShapeKind::ALL.into_iter().zip(six).zip(skips).zip(reasons)
    {
        let Some(rows) = rows else {
            continue;
        };
        let tangled = Tangled::new(Elements::Reasons(rows));
        let pairs = statistics.as_ref().map(Pairs::new);
        let mut fold = Fold::new(findings);
        for i in 0..rows.len() {
            for j in i..rows.len() {
                // A pair whose two elements differ is SHP006's.
                let (Some(reason), Some(mirror)) = (at(rows, i, j), at(rows, j, i)) else {
                    continue;
                };
                let (Some(a), Some(b)) = (shapes.link(kind, i), shapes.link(kind, j)) else {
                    continue;
                };
                let expected = match a == b {
                    true => Some(SkipReason::SameLink),
                    false => pairs
                        .as_ref()
                        .and_then(|pairs| pairs.read(i, j))
                        .filter(Pair::in_order)
                        .and_then(|pair| first_reason(&pair, joined.contains(&ordered(a, b)))),
                };
                let Some(expected) = expected else {
                    continue;
                };
                // Whether the pair is in contact in the default configuration is SHP026's.
                let after_default = matches!(expected, SkipReason::Never | SkipReason::None);
                if reason == SkipReason::Default && after_default {
                    continue;
                }
                // Where the skip itself is wrong, SHP011 says so.
                let skipped = matches!(expected, SkipReason::SameLink | SkipReason::Always);
                let skip = skips.and_then(|skips| at(skips, i, j)).unwrap_or(skipped);
                let tangled = reason != mirror || tangled.pair(i, j);
                if tangled || reason == expected || (i != j && skip != skipped) {
                    continue;
                }
                fold.add(|| {
                    Finding::at(
                        module.file("module.json"),
                        format!("/reasons/{}/{i}/{j}", kind.key()),
                        format!(
                            "for shapes {} and {} this is not the first reason that applies",
                            shapes.describe(context, kind, i),
                            shapes.describe(context, kind, j)
                        ),
                    )
                    .expected(format!("{expected:?}"))
                    .actual(format!("{reason:?}"))
                });
            }
        }
        fold.finish();
    }
}

/// The first reason that applies to shapes of two links; `None` where that hangs on the last digit.
fn first_reason(pair: &Pair, adjacent: bool) -> Option<SkipReason> {
    if pair.always()? {
        return Some(SkipReason::Always);
    }
    if adjacent {
        return Some(SkipReason::Adjacent);
    }
    Some(match pair.never()? {
        true => SkipReason::Never,
        false => SkipReason::None,
    })
}

fn ordered(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}
