use super::subject;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
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
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some((module, model)) = subject(context) else {
        return;
    };
    let stated = &model.evaluation;
    let all = u64::from(stated.num_colliding.0) + u64::from(stated.num_free.0);
    if all != u64::from(EVALUATION_COUNT) {
        let message = "`num_colliding` and `num_free` together are not all configurations";
        let finding = Finding::at(module.file("module.json"), "/evaluation", message);
        findings.report(finding.expected(EVALUATION_COUNT).actual(all));
    }
    for (key, count, what, most) in [
        (
            "num_missed",
            stated.num_missed,
            "num_colliding",
            stated.num_colliding,
        ),
        (
            "num_near_contact",
            stated.num_near_contact,
            "num_colliding",
            stated.num_colliding,
        ),
        (
            "num_near_contact_missed",
            stated.num_near_contact_missed,
            "num_near_contact",
            stated.num_near_contact,
        ),
        (
            "num_near_contact_missed",
            stated.num_near_contact_missed,
            "num_missed",
            stated.num_missed,
        ),
        (
            "num_cleared",
            stated.num_cleared,
            "num_free",
            stated.num_free,
        ),
    ] {
        if count.0 > most.0 {
            let pointer = format!("/evaluation/{key}");
            let message = format!("this is more than `{what}`");
            let finding = Finding::at(module.file("module.json"), pointer, message);
            findings.report(finding.expected(format!("at most {most}")).actual(count));
        }
    }
    let range = |of: &SampleRange| {
        let first = u64::from(of.first_sample_idx.0);
        first..first + u64::from(of.num_configurations.0)
    };
    let (training, calibration) = (range(&model.training), range(&model.calibration));
    let mut report = |key: &str, message: &str| {
        let pointer = format!("/{key}");
        findings.report(Finding::at(module.file("module.json"), pointer, message));
    };
    for (key, range) in [("training", &training), ("calibration", &calibration)] {
        if range.is_empty() {
            report(key, "it has no configuration");
        } else if range.end > u64::from(EVALUATION_FIRST) {
            report(key, "configurations from 2^31 on are kept for counting");
        }
    }
    if training.start < calibration.end && calibration.start < training.end {
        report(
            "calibration",
            "some of these configurations are in `training` too",
        );
    }
}
