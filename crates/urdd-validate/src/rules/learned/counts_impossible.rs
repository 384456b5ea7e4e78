use crate::rules::prelude::*;
use urdd_format::self_collision_model::{EVALUATION_COUNT, EVALUATION_FIRST, SampleRange};

declare_rule! {
    /// The counts of the self-collision model cannot be: they are larger than what they count among, or the model was
    /// made on configurations that the specification keeps for counting.
    ///
    /// Rates on configurations that a model has seen say nothing about those that it has not.
    ///
    /// Take `training` and `calibration` from different parts of the sequence of SPEC 9.3, both below 2^31, and count
    /// again.
    LRN009 "model-counts-impossible", Error, clause "8.8.8", since "0.2.0",
    phase References, needs [Version1, Module(Kind::SelfCollisionModel)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
