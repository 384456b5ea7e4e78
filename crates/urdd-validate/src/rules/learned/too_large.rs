use super::subject;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;

declare_rule! {
    /// The self-collision model is larger than a model may be.
    ///
    /// A model is worth having where it is faster than the exact check that it stands for. One that is padded with weights
    /// also makes it costly to count its collisions again.
    ///
    /// At most 65,536 weights and biases, and 100 test vectors. Train a smaller network.
    LRN005 "model-too-large", Error, clause "8.8.4", since "0.2.0",
    phase References, needs [Version1, Module(Kind::SelfCollisionModel)],
    check check,
}

/// Most weights and biases.
const MAX_NUMBERS: usize = 65_536;
/// Most test vectors.
const MAX_VECTORS: usize = 100;

fn check(context: &Context, findings: &mut Findings) {
    let Some((module, model)) = subject(context) else {
        return;
    };
    let layers = model.layers.iter();
    let numbers = layers.map(|of| of.weights.iter().map(Vec::len).sum::<usize>() + of.biases.len());
    for (pointer, what, most, actual) in [
        ("/layers", "weights and biases", MAX_NUMBERS, numbers.sum()),
        (
            "/test_vectors",
            "test vectors",
            MAX_VECTORS,
            model.test_vectors.len(),
        ),
    ] {
        if actual > most {
            let message = format!("too many {what}");
            let finding = Finding::at(module.file("module.json"), pointer, message);
            findings.report(finding.expected(format!("at most {most}")).actual(actual));
        }
    }
}
