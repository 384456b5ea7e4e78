use crate::rules::prelude::*;
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
        Module(Kind::ConvexDecompositionMeshes), Module(Kind::LinkShapesSkips), POSES_KNOWN, BOUNDS_SOUND,
        PIECES_LISTED, NotFailed(MSH020), NotFailed(MSH021), NotFailed(MSH022), Passed(LRN003), Passed(LRN004),
        Passed(LRN005), NotFailed(LRN006), NotFailed(LRN007), NotFailed(LRN008), Passed(LRN009), Passed(LRN012),
    ],
}

/// A count may differ by one per this many configurations that it is counted among.
const PER_TOLERANCE: u32 = 10_000;

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let judge = findings.or_skip(context.model_judge())?;
    let found = findings.or_skip(judge.count(EVALUATION_FIRST, EVALUATION_COUNT))?;
    let stated = &model.evaluation;
    let (colliding, near) = (found.num_colliding, found.num_near_contact);
    let (missed, near_missed) = (found.num_missed, found.num_near_contact_missed);
    let (cleared, free) = (found.num_cleared, found.num_free);
    for (key, stated, found, among) in [
        ("num_colliding", stated.num_colliding, colliding, EVALUATION_COUNT),
        ("num_missed", stated.num_missed, missed, colliding.0),
        ("num_near_contact", stated.num_near_contact, near, colliding.0),
        ("num_near_contact_missed", stated.num_near_contact_missed, near_missed, near.0),
        ("num_cleared", stated.num_cleared, cleared, free.0),
    ] {
        let tolerance = among.div_ceil(PER_TOLERANCE);
        if found.0.abs_diff(stated.0) > tolerance {
            let message = "counting these configurations again gives a different number";
            finding_in(Kind::SelfCollisionModel, format!("/evaluation/{key}"), message)
                .values(found, stated)
                .tolerance(f64::from(tolerance))
                .report(findings);
        }
    }
    Some(())
}
