use std::collections::BTreeSet;

use super::subject;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::fold::Fold;
use crate::learned::pairs;
use crate::rule::declare_rule;

declare_rule! {
    /// The pairs of the self-collision model are not the pairs of links that are not skipped.
    ///
    /// A pair that is missing is in collision without the model's knowledge; one too many holds free configurations to
    /// be in collision.
    ///
    /// List every pair of links of which two pieces are not skipped, in `pairs`, or, where it is never near, in
    /// `other_pairs`.
    LRN007 "model-pairs-differ", Error, clause "8.8.5", since "0.2.0",
    phase References, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes), Module(Kind::LinkShapesSkips),
        PIECES_LISTED, Passed(SHP005), NotFailed(SHP010), NotFailed(SHP013), NotFailed(LRN001), NotFailed(LRN006),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some((module, model)), Some(expected)) =
        (subject(context), pairs::not_skipped(context.urdd()))
    else {
        return;
    };
    let expected: BTreeSet<[usize; 2]> = expected.into_iter().collect();
    let outputs = model.pairs.iter();
    let outputs = outputs.map(|of| [of.link_a_idx.get(), of.link_b_idx.get()]);
    let others = model.other_pairs.iter();
    let others = others.map(|of| [of.link_a_idx.get(), of.link_b_idx.get()]);
    let named = |[a, b]: [usize; 2]| {
        let (a, b) = (context.link_label(a), context.link_label(b));
        format!("{a} and {b}")
    };
    let file = || module.file("module.json");
    let mut fold = Fold::new(findings);
    let lists = [
        ("pairs", outputs.clone().collect::<Vec<_>>()),
        ("other_pairs", others.clone().collect()),
    ];
    for (list, pairs) in lists {
        for (place, pair) in pairs.into_iter().enumerate() {
            if !expected.contains(&pair) {
                fold.add(|| {
                    let message = format!("{} are skipped", named(pair));
                    Finding::at(file(), format!("/{list}/{place}"), message)
                });
            }
        }
    }
    fold.finish();
    let found: BTreeSet<[usize; 2]> = outputs.chain(others).collect();
    let mut fold = Fold::new(findings);
    for pair in expected.difference(&found) {
        fold.add(|| {
            let message = format!("{} are not skipped, and not among the pairs", named(*pair));
            Finding::at(file(), "/pairs", message)
        });
    }
    fold.finish();
}
