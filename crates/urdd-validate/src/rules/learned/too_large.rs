use crate::rules::prelude::*;

declare_rule! {
    /// The self-collision model is larger than a model may be.
    ///
    /// A model is worth having where it is faster than the exact check that it replaces. One that is padded with
    /// weights also makes it costly to count its collisions again.
    ///
    /// At most 65,536 weights and biases, and 100 test vectors. Train a smaller network.
    LRN005 "model-too-large", Error, clause "8.8.4", since "0.2.0",
    phase References, needs [Version1, Module(Kind::SelfCollisionModel)],
}

/// Maximum number of weights and biases.
const MAX_NUMBERS: usize = 65_536;
/// Maximum number of test vectors.
const MAX_VECTORS: usize = 100;

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let layers = model.layers.iter();
    let numbers = layers.map(|of| of.weights.iter().map(Vec::len).sum::<usize>() + of.biases.len());
    let vectors = model.test_vectors.len();
    for (pointer, what, most, actual) in [
        ("/layers", "weights and biases", MAX_NUMBERS, numbers.sum()),
        ("/test_vectors", "test vectors", MAX_VECTORS, vectors),
    ] {
        if actual > most {
            let finding = finding_in(Kind::SelfCollisionModel, pointer, format!("too many {what}"));
            findings.report(finding.values(format!("at most {most}"), actual));
        }
    }
    Some(())
}
