use super::subject;
use crate::format::self_collision_model::SampleRange;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::learned::counts::Found;
use crate::validate::rule::declare_rule;

declare_rule! {
    /// The counts of the self-collision model cannot be: they are larger than what they count among, or of
    /// configurations that it was trained on.
    ///
    /// Rates on configurations that a model has seen say nothing about those that it has not.
    ///
    /// Take `training`, `calibration` and `held_out` from different parts of the sequence of SPEC 9.3, and count
    /// again.
    LRN009 "model-counts-impossible", Error, clause "8.8.8", since "0.2.0",
    phase References, needs [Version1, Module(Kind::SelfCollisionModel)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some((module, model)) = subject(context) else {
        return;
    };
    let mut report = |pointer: &str, message: &str, expected: u64, actual: u64| {
        let finding = Finding::at(module.file("module.json"), pointer, message);
        findings.report(
            finding
                .expected(format!("at most {expected}"))
                .actual(actual),
        );
    };
    let held_out = &model.held_out;
    let stated = Found::from(held_out);
    let (all, colliding) = (stated.configurations, stated.colliding);
    let (missed, cleared) = (stated.missed, stated.cleared);
    if colliding > all {
        let message = "more configurations are in collision than there are";
        return report("/held_out/num_colliding", message, all, colliding);
    }
    if missed > colliding {
        let message = "more collisions are missed than there are";
        report("/held_out/num_missed", message, colliding, missed);
    }
    if cleared > all - colliding {
        let message = "more configurations are cleared than are free of collisions";
        report("/held_out/num_cleared", message, all - colliding, cleared);
    }
    let range = |first: u32, count: u32| u64::from(first)..u64::from(first) + u64::from(count);
    let of = |of: &SampleRange| range(of.first_sample_idx.0, of.num_configurations.0);
    let ranges = [
        ("training", of(&model.training)),
        ("calibration", of(&model.calibration)),
        (
            "held_out",
            range(held_out.first_sample_idx.0, held_out.num_configurations.0),
        ),
    ];
    for (place, (name, range)) in ranges.iter().enumerate() {
        let pointer = format!("/{name}");
        let at = || module.file("module.json");
        if range.is_empty() {
            let message = "there is no configuration".to_owned();
            findings.report(Finding::at(at(), pointer, message));
        } else if range.end > 1 << 32 {
            let message = "sampled configurations have numbers below 2^32".to_owned();
            findings.report(Finding::at(at(), pointer, message));
        } else if let Some((other, _)) = ranges[..place]
            .iter()
            .find(|(_, other)| other.start < range.end && range.start < other.end)
        {
            let message = format!("some of these configurations are of `{other}` too");
            findings.report(Finding::at(at(), pointer, message));
        }
    }
}
