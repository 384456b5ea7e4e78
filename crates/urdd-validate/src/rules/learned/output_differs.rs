use crate::learned::network::Network;
use crate::rules::prelude::*;

declare_rule! {
    /// The self-collision model does not give the clearances that its test vectors say.
    ///
    /// Either the network's numbers are not those that were trained, or the producer evaluates it otherwise than this
    /// specification says; then its counts are of something else too.
    ///
    /// Look at the order of the inputs, at the hyperbolic tangent after every layer but the last, and at the margin,
    /// which is subtracted. `examples/self_collision_model.py` is a short consumer to compare with.
    LRN008 "model-output-differs", Error, clause "8.8.6", since "0.2.0",
    phase Kinematics, needs [Version1, Module(Kind::SelfCollisionModel), Passed(LRN003), Passed(LRN004), Passed(LRN005)],
}

/// Tolerance of a clearance, as a fraction of the larger absolute value or of the clip distance.
const TOLERANCE: f64 = 1e-9;

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let network = Network::new(model);
    for (place, vector) in model.test_vectors.iter().enumerate() {
        let found = network.clearances(&vector.configuration);
        for (pair, (expected, actual)) in found.iter().zip(&vector.clearances).enumerate() {
            let scale = expected.abs().max(actual.abs());
            let tolerance = TOLERANCE * scale.max(model.clip_distance.abs());
            let off = actual - expected;
            // NaN is reported too.
            if off.abs() <= tolerance {
                continue;
            }
            let pointer = format!("/test_vectors/{place}/clearances/{pair}");
            let message = "this is not what the network gives in this configuration";
            finding_in(Kind::SelfCollisionModel, pointer, message)
                .values(expected, actual)
                .tolerance(tolerance)
                .off_by(off, "m")
                .report(findings);
            return Some(());
        }
    }
    Some(())
}
