use super::subject;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::learned::counts::Found;
use crate::validate::learned::{fisher, network};
use crate::validate::rule::declare_rule;

declare_rule! {
    /// On configurations that its producer did not choose, the self-collision model is worse than it says.
    ///
    /// The counts that are stated may be of configurations that suit it. These configurations follow from the model's
    /// own numbers, so that nobody can choose them; that the stated rates hold, and this came about by chance, has a
    /// probability below one in a million.
    ///
    /// Count on configurations that had no part in training, nor in choosing between models.
    LRN011 "model-rates-not-met", Error, clause "8.8.10", since "0.2.0",
    phase Statistics, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes), Module(Kind::LinkShapesSkips),
        POSES_KNOWN, BOUNDS_SOUND, PIECES_LISTED, NotFailed(MSH020), NotFailed(MSH021), NotFailed(MSH022),
        Passed(LRN003), Passed(LRN004), Passed(LRN005), NotFailed(LRN006), NotFailed(LRN007), NotFailed(LRN008),
        Passed(LRN009), NotFailed(LRN010),
    ],
    check check,
}

/// How improbable a result must be.
const IMPROBABLE: f64 = 1e-6;
/// Configurations that are looked at; with `--deep` ten times as many.
const CONFIGURATIONS: u32 = 10_000;

fn check(context: &Context, findings: &mut Findings) {
    let Some((module, model)) = subject(context) else {
        return;
    };
    let judge = match context.model_judge() {
        Ok(judge) => judge,
        Err(reason) => return findings.skip(reason.clone()),
    };
    let count = match context.is_deep() {
        true => 10 * CONFIGURATIONS,
        false => CONFIGURATIONS,
    };
    // Half of what the stated counts may take.
    let count = judge.affordable(2 * count, context.is_deep()) / 2;
    let first = network::first_fresh(model);
    let found = match judge.count(first, count) {
        Ok(found) => found,
        Err(reason) => return findings.skip(reason),
    };
    let stated = Found::from(&model.held_out);
    let kept = |of: &Found| [of.free() - of.cleared, of.free()];
    let lost = |of: &Found| [of.missed, of.colliding];
    for (key, what, [x, of], [stated, among]) in [
        (
            "num_missed",
            "collisions are missed",
            lost(&found),
            lost(&stated),
        ),
        (
            "num_cleared",
            "free configurations are not cleared",
            kept(&found),
            kept(&stated),
        ),
    ] {
        let probability = fisher::this_many_or_more([x, of], [stated, among]);
        if probability < IMPROBABLE {
            let message = format!(
                "of sampled configurations {first} and {} after it, {x} of {of} {what}, and {stated} of {among} are stated; that has a probability of {probability:.1e}",
                count.saturating_sub(1)
            );
            let pointer = format!("/held_out/{key}");
            findings.report(Finding::at(module.file("module.json"), pointer, message));
        }
    }
}
