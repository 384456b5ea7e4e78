use super::subject;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::learned::network::Network;
use crate::rule::declare_rule;

declare_rule! {
    /// The self-collision model does not give the clearances that its test vectors say.
    ///
    /// Either the network's numbers are not those that were trained, or the producer evaluates it otherwise than this
    /// specification says; then its counts are of something else too.
    ///
    /// Look at the order of the inputs, at the hyperbolic tangent after every layer but the last, and at the margin,
    /// which is subtracted. `examples/self_collision_model.py` is a consumer of some lines to compare with.
    LRN008 "model-output-differs", Error, clause "8.8.6", since "0.2.0",
    phase Kinematics, needs [
        Version1, Module(Kind::SelfCollisionModel), Passed(LRN003), Passed(LRN004), Passed(LRN005),
    ],
    check check,
}

/// How far a clearance may be off, as a part of the larger absolute value, or of the clip distance.
const TOLERANCE: f64 = 1e-9;

fn check(context: &Context, findings: &mut Findings) {
    let Some((module, model)) = subject(context) else {
        return;
    };
    let network = Network::new(model);
    for (place, vector) in model.test_vectors.iter().enumerate() {
        let found = network.clearances(&vector.configuration);
        for (pair, (expected, actual)) in found.iter().zip(&vector.clearances).enumerate() {
            let scale = expected
                .abs()
                .max(actual.abs())
                .max(model.clip_distance.abs());
            let tolerance = TOLERANCE * scale;
            let off = actual - expected;
            // What is not a number is off too.
            if off.abs() <= tolerance {
                continue;
            }
            return findings.report(
                Finding::at(
                    module.file("module.json"),
                    format!("/test_vectors/{place}/clearances/{pair}"),
                    "this is not what the network gives in this configuration",
                )
                .expected(expected)
                .actual(actual)
                .tolerance(tolerance)
                .off_by(off, "m"),
            );
        }
    }
}
