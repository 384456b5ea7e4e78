use crate::learned::network;
use crate::rules::prelude::*;
use urdd_format::rate::Rate;
use urdd_format::self_collision_model::{CONFIRMATION_COUNT, CONFIRMATION_FIRST};

declare_rule! {
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
    phase Statistics, needs [Version1, Module(Kind::SelfCollisionModel), Passed(LRN010)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
