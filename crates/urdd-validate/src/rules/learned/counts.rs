use crate::reference::learned::counts::PER_TOLERANCE;
use crate::reference::learned::network;
use crate::rules::prelude::*;
use urdd_format::index::Count;
use urdd_format::rate::Rate;
use urdd_format::self_collision_model::{
    CONFIRMATION_COUNT, CONFIRMATION_FIRST, EVALUATION_COUNT, EVALUATION_FIRST, EVALUATION_MIN,
    SampleRange,
};

declare_rule! {
    /// The counts of the self-collision model cannot be: they are larger than what they count among, or the model was
    /// made on configurations that the specification keeps for counting.
    ///
    /// Rates on configurations that a model has seen say nothing about those that it has not.
    ///
    /// Take `training` and `calibration` from different parts of the sequence of SPEC 9.3, both below 2^31, and count
    /// again.
    LRN009 "model-counts-impossible", Error, clause "8.8.8", since "0.2.0",
    phase References, needs [Version1, Module(Kind::SelfCollisionModel)], check counts_impossible,

    /// The rates of the self-collision model rest on too few collisions, or too few free configurations.
    ///
    /// Where 3 in 1,000 configurations collide, a model that clears everything is right in 997 of 1,000. Its miss rate is
    /// 100 %, and only many collisions show that.
    ///
    /// Leave the model out. It saves nothing for a robot that hardly ever collides with itself, or nearly always does.
    LRN012 "model-counts-few", Error, clause "8.8.9", since "1.0.0",
    phase References, needs [Version1, Module(Kind::SelfCollisionModel), Passed(LRN009)], check counts_few,

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
        PIECES_LISTED, NoneFailed(&[MSH020, MSH021, MSH022]), Passed(LRN003), Passed(LRN004),
        Passed(LRN005), NoneFailed(&[LRN006, LRN007, LRN008]), Passed(LRN009), Passed(LRN012),
    ], check counts_differ,

    /// On other configurations the self-collision model is worse than it says.
    ///
    /// A producer can fit a model to the configurations that its counts are of. So the validator counts twice more: on
    /// configurations that the specification fixes, and on some that follow from the model's own numbers, which no
    /// training can know. The model is at fault where the 95 % intervals of the two rates do not overlap, and the rate
    /// that the validator finds is the worse.
    ///
    /// Train without the configurations from 2^31 on, and do not choose between models by them. The rates of about one
    /// in a hundred honest models are not confirmed by chance; train such a model again from other weights.
    LRN011 "model-rates-not-met", Error, clause "8.8.12", since "0.2.0",
    phase Statistics, needs [Version1, Module(Kind::SelfCollisionModel), Passed(LRN010)], check rates_not_met,
}

fn counts_impossible(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let stated = &model.evaluation;
    let all = u64::from(stated.num_colliding.0) + u64::from(stated.num_free.0);
    if all != u64::from(EVALUATION_COUNT) {
        let message = "`num_colliding` and `num_free` together are not all configurations";
        let finding = finding_in(Kind::SelfCollisionModel, "/evaluation", message);
        findings.report(finding.values(EVALUATION_COUNT, all));
    }
    let colliding = ("num_colliding", stated.num_colliding);
    let missed = ("num_missed", stated.num_missed);
    let near = ("num_near_contact", stated.num_near_contact);
    let near_missed = ("num_near_contact_missed", stated.num_near_contact_missed);
    let cleared = ("num_cleared", stated.num_cleared);
    let free = ("num_free", stated.num_free);
    for ((key, count), (what, most)) in [
        (missed, colliding),
        (near, colliding),
        (near_missed, near),
        (near_missed, missed),
        (cleared, free),
    ] {
        if count.0 > most.0 {
            let message = format!("this is more than `{what}`");
            let finding =
                finding_in(Kind::SelfCollisionModel, format!("/evaluation/{key}"), message);
            findings.report(finding.values(format!("at most {most}"), count));
        }
    }
    let range = |of: &SampleRange| {
        let first = u64::from(of.first_sample_idx.0);
        first..first + u64::from(of.num_configurations.0)
    };
    let (training, calibration) = (range(&model.training), range(&model.calibration));
    let mut report = |key: &str, message: &str| {
        finding_in(Kind::SelfCollisionModel, format!("/{key}"), message).report(findings);
    };
    for (key, range) in [("training", &training), ("calibration", &calibration)] {
        if range.is_empty() {
            report(key, "it has no configuration");
        } else if range.end > u64::from(EVALUATION_FIRST) {
            report(key, "configurations from 2^31 on are reserved for counting");
        }
    }
    if training.start < calibration.end && calibration.start < training.end {
        let message = "some of these configurations are also in `training`";
        report("calibration", message);
    }
    Some(())
}

fn counts_few(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let stated = &model.evaluation;
    for (key, what, count) in [
        ("num_colliding", "collisions", stated.num_colliding),
        ("num_free", "free configurations", stated.num_free),
    ] {
        if count.0 < EVALUATION_MIN {
            let message = format!("too few {what} to state a rate");
            finding_in(Kind::SelfCollisionModel, format!("/evaluation/{key}"), message)
                .values(format!("at least {EVALUATION_MIN}"), count)
                .report(findings);
        }
    }
    Some(())
}

fn counts_differ(context: &Context, findings: &mut Findings) -> Option<()> {
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
        let pointer = format!("/evaluation/{key}");
        let counted = counted_again(Kind::SelfCollisionModel, pointer, [stated, found], among);
        counted.into_iter().for_each(|finding| findings.report(finding));
    }
    Some(())
}

/// The finding of a number of configurations among so many, where counting again gives another one.
pub(in crate::rules) fn counted_again(
    kind: Kind,
    pointer: String,
    [stated, found]: [Count; 2],
    among: u32,
) -> Option<Finding> {
    let tolerance = among.div_ceil(PER_TOLERANCE);
    let message = "counting these configurations again gives a different number";
    let differs = found.0.abs_diff(stated.0) > tolerance;
    let finding = || finding_in(kind, pointer, message).values(found, stated);
    differs.then(|| finding().tolerance(f64::from(tolerance)))
}

fn rates_not_met(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let judge = findings.or_skip(context.model_judge())?;
    let stated = &model.evaluation;
    for first in [CONFIRMATION_FIRST, network::second_confirmation(model)] {
        let found = findings.or_skip(judge.count(first, CONFIRMATION_COUNT))?;
        let last = first + (CONFIRMATION_COUNT - 1);
        let mut report = |key: &str, what: &str, stated: Rate, found: Rate| {
            let message = format!("{what} on sampled configurations {first} to {last} than stated");
            finding_in(Kind::SelfCollisionModel, format!("/evaluation/{key}"), message)
                .values(found.to_string(), stated.to_string())
                .report(findings);
        };
        let (stated_misses, misses) = (stated.miss_rate(), found.miss_rate());
        if misses.is_above(&stated_misses) {
            let what = "the model misses more collisions";
            report("num_missed", what, stated_misses, misses);
        }
        let (stated_clears, clears) = (stated.clear_rate(), found.clear_rate());
        if stated_clears.is_above(&clears) {
            let what = "the model clears fewer free configurations";
            report("num_cleared", what, stated_clears, clears);
        }
    }
    Some(())
}
