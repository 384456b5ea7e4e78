use super::subject;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::learned::counts::{self, Found};
use crate::validate::rule::declare_rule;
use crate::validate::skip::SkipReason;

declare_rule! {
    /// The counts of the self-collision model are not what comes of the configurations that they are of.
    ///
    /// The share of collisions that a model misses is what a planner counts on. The configurations are defined, so
    /// that it can be counted again, and it was.
    ///
    /// Where counting takes long, only the first configurations are looked at, and a count is at fault where it is
    /// exceeded by them; `--deep` counts all. Count again, with the margins and numbers as they are in the document,
    /// the pairs and pieces of SPEC 8.8.5, and the configurations of SPEC 9.3.
    LRN010 "model-counts-differ", Error, clause "8.8.9", since "0.2.0",
    phase Statistics, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes), Module(Kind::LinkShapesSkips),
        POSES_KNOWN, BOUNDS_SOUND, PIECES_LISTED, NotFailed(MSH020), NotFailed(MSH021), NotFailed(MSH022),
        Passed(LRN003), Passed(LRN004), Passed(LRN005), NotFailed(LRN006), NotFailed(LRN007), NotFailed(LRN008),
        Passed(LRN009),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some((module, model)) = subject(context) else {
        return;
    };
    let judge = match context.model_judge() {
        Ok(judge) => judge,
        Err(reason) => return findings.skip(reason.clone()),
    };
    let all = model.held_out.num_configurations.0;
    let some = judge.affordable(all, context.is_deep());
    let found = match judge.count(model.held_out.first_sample_idx.0, some) {
        Ok(found) => found,
        Err(reason) => return findings.skip(reason),
    };
    let tolerance = u64::from(all.div_ceil(counts::PER_TOLERANCE));
    let stated = Found::from(&model.held_out);
    for (key, stated, found) in [
        ("num_colliding", stated.colliding, found.colliding),
        ("num_missed", stated.missed, found.missed),
        ("num_cleared", stated.cleared, found.cleared),
    ] {
        // Of a part of the configurations, no more can be said than that there are too many.
        let differs = match some == all {
            true => found.abs_diff(stated) > tolerance,
            false => found > stated + tolerance,
        };
        if differs {
            let message = match some == all {
                true => "this is not what comes of these configurations".to_owned(),
                false => format!("the first {some} of these configurations give more"),
            };
            findings.report(
                Finding::at(
                    module.file("module.json"),
                    format!("/held_out/{key}"),
                    message,
                )
                .expected(found)
                .actual(stated)
                .tolerance(tolerance as f64),
            );
        }
    }
    if findings.is_empty() && some < all {
        findings.skip(SkipReason::NotDeep(vec!["self_collision_model_module"]));
    }
}
