use crate::learned::pairs;
use crate::rules::prelude::*;

declare_rule! {
    /// The pairs of the self-collision model are not the pairs of links that are not skipped.
    ///
    /// A pair that is missing can collide without the model's knowledge; one too many makes free configurations count
    /// as collisions.
    ///
    /// List every pair of links of which two pieces are not skipped, in `pairs`, or, where it is never near, in
    /// `other_pairs`.
    LRN007 "model-pairs-differ", Error, clause "8.8.5", since "0.2.0",
    phase References, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes), Module(Kind::LinkShapesSkips), PIECES_LISTED, Passed(SHP005),
        NotFailed(SHP010), NotFailed(SHP013), NotFailed(LRN001), NotFailed(LRN006),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let expected: BTreeSet<[usize; 2]> = pairs::not_skipped(context)?.into_iter().collect();
    let outputs = model.pairs.iter().map(|of| [of.link_a_idx.get(), of.link_b_idx.get()]);
    let others = model.other_pairs.iter().map(|of| [of.link_a_idx.get(), of.link_b_idx.get()]);
    let found: BTreeSet<[usize; 2]> = outputs.clone().chain(others.clone()).collect();
    let named = |[a, b]: [usize; 2]| {
        let (a, b) = (context.link_label(a), context.link_label(b));
        format!("{a} and {b}")
    };
    let outputs = outputs.enumerate().map(|(place, pair)| ("pairs", place, pair));
    let others = others.enumerate().map(|(place, pair)| ("other_pairs", place, pair));
    let mut fold = Fold::new(findings);
    for (list, place, pair) in outputs.chain(others) {
        if !expected.contains(&pair) {
            fold.add(|| {
                let message = format!("{} are skipped", named(pair));
                finding_in(Kind::SelfCollisionModel, format!("/{list}/{place}"), message)
            });
        }
    }
    drop(fold);
    let mut fold = Fold::new(findings);
    for pair in expected.difference(&found) {
        fold.add(|| {
            let message = format!("{} are not skipped, and not among the pairs", named(*pair));
            finding_in(Kind::SelfCollisionModel, "/pairs", message)
        });
    }
    Some(())
}
