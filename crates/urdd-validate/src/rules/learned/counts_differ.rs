use super::subject;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::self_collision_model::{EVALUATION_COUNT, EVALUATION_FIRST};

declare_rule! {
    /// The counts of the self-collision model are not those of the configurations that the specification fixes.
    ///
    /// A planner counts on the share of collisions that a model misses. SPEC 8.8.9 defines the configurations, so the
    /// validator counts all of them again.
    ///
    /// Count again, with the margins and numbers as they are in the document, the pairs and pieces of SPEC 8.8.5, and
    /// sampled configurations 2^31 to 2^31 + 49,999 of SPEC 9.3. Where the robot has so many convex pieces that counting
    /// takes too much work, the model is reported as not verified; `--deep` allows more.
    LRN010 "model-counts-differ", Error, clause "8.8.9", since "0.2.0",
    phase Statistics, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes), Module(Kind::LinkShapesSkips),
        POSES_KNOWN, BOUNDS_SOUND, PIECES_LISTED, NotFailed(MSH020), NotFailed(MSH021), NotFailed(MSH022),
        Passed(LRN003), Passed(LRN004), Passed(LRN005), NotFailed(LRN006), NotFailed(LRN007), NotFailed(LRN008),
        Passed(LRN009), Passed(LRN012),
    ],
    check check,
}

/// A count may be off by one for every so many that it is counted among.
const PER_TOLERANCE: u32 = 10_000;

fn check(context: &Context, findings: &mut Findings) {
    let Some((module, model)) = subject(context) else {
        return;
    };
    let judge = match context.model_judge() {
        Ok(judge) => judge,
        Err(reason) => return findings.skip(reason.clone()),
    };
    let found = match judge.count(EVALUATION_FIRST, EVALUATION_COUNT) {
        Ok(found) => found,
        Err(reason) => return findings.skip(reason),
    };
    let stated = &model.evaluation;
    for (key, stated, found, among) in [
        (
            "num_colliding",
            stated.num_colliding,
            found.num_colliding,
            EVALUATION_COUNT,
        ),
        (
            "num_missed",
            stated.num_missed,
            found.num_missed,
            found.num_colliding.0,
        ),
        (
            "num_near_contact",
            stated.num_near_contact,
            found.num_near_contact,
            found.num_colliding.0,
        ),
        (
            "num_near_contact_missed",
            stated.num_near_contact_missed,
            found.num_near_contact_missed,
            found.num_near_contact.0,
        ),
        (
            "num_cleared",
            stated.num_cleared,
            found.num_cleared,
            found.num_free.0,
        ),
    ] {
        let tolerance = among.div_ceil(PER_TOLERANCE);
        if found.0.abs_diff(stated.0) > tolerance {
            findings.report(
                Finding::at(
                    module.file("module.json"),
                    format!("/evaluation/{key}"),
                    "counting these configurations again gives another number",
                )
                .expected(found)
                .actual(stated)
                .tolerance(f64::from(tolerance)),
            );
        }
    }
}
