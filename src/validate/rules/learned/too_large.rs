use super::subject;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::rule::declare_rule;

declare_rule! {
    /// The self-collision model is larger than a model may be.
    ///
    /// A model that costs more than the distances that it stands for is of no use, and one whose counts take hours to
    /// check again is not checked.
    ///
    /// At most 1,000,000 weights and biases, 1,000,000 held-out configurations, 100 test vectors.
    LRN005 "model-too-large", Error, clause "8.8.4", since "0.2.0",
    phase References, needs [Version1, Module(Kind::SelfCollisionModel)],
    check check,
}

/// Most weights and biases.
const MOST_NUMBERS: usize = 1_000_000;
/// Most configurations that counts are of.
const MOST_CONFIGURATIONS: usize = 1_000_000;
/// Most test vectors.
const MOST_VECTORS: usize = 100;

fn check(context: &Context, findings: &mut Findings) {
    let Some((module, model)) = subject(context) else {
        return;
    };
    let layers = model.layers.iter();
    let numbers = layers.map(|of| of.weights.iter().map(Vec::len).sum::<usize>() + of.biases.len());
    let held_out = model.held_out.num_configurations.get();
    for (pointer, what, most, actual) in [
        ("/layers", "weights and biases", MOST_NUMBERS, numbers.sum()),
        (
            "/held_out/num_configurations",
            "held-out configurations",
            MOST_CONFIGURATIONS,
            held_out,
        ),
        (
            "/test_vectors",
            "test vectors",
            MOST_VECTORS,
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
