use crate::rules::prelude::*;
use urdd_format::self_collision_model::EVALUATION_MIN;

declare_rule! {
    /// The rates of the self-collision model rest on too few collisions, or too few free configurations.
    ///
    /// Where 3 in 1,000 configurations collide, a model that clears everything is right in 997 of 1,000. Its miss rate is
    /// 100 %, and only many collisions show that.
    ///
    /// Leave the model out. It saves nothing for a robot that hardly ever collides with itself, or nearly always does.
    LRN012 "model-counts-few", Error, clause "8.8.9", since "1.0.0",
    phase References, needs [Version1, Module(Kind::SelfCollisionModel), Passed(LRN009)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
