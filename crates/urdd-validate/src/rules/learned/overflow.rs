use super::subject;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::self_collision_model::ModelInput;

declare_rule! {
    /// The numbers of a layer of the self-collision model are so large that their sum may be beyond 64-bit numbers.
    ///
    /// Infinities and differences of infinities follow, and comparisons with these say what they like: a model that
    /// clears everything.
    ///
    /// Train the model again, with weights that stay small.
    LRN004 "model-overflows", Error, clause "8.8.4", since "0.2.0",
    phase References, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::Bounds), NotFailed(BND001),
        NotFailed(LRN001), NotFailed(LRN002), NotFailed(LRN003),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some((module, model)), Some(bounds)) = (subject(context), context.bounds()) else {
        return;
    };
    let mut largest: Vec<f64> = Vec::new();
    for input in &model.inputs {
        match input {
            ModelInput::Angle(_) => largest.extend([1.0; 4]),
            ModelInput::RotationVector(_) => largest.extend([1.0; 9]),
            ModelInput::Length(of) => {
                let ends = bounds
                    .bounds
                    .get(of.dof_idx.get())
                    .copied()
                    .unwrap_or_default();
                let far = ends.map(|end| ((end - of.middle) / of.half_range).abs());
                largest.push(far[0].max(far[1]));
            }
        }
    }
    for (place, layer) in model.layers.iter().enumerate() {
        for (row, (weights, bias)) in layer.weights.iter().zip(&layer.biases).enumerate() {
            let products = weights.iter().zip(&largest).map(|(w, x)| (w * x).abs());
            let sum = bias.abs() + products.sum::<f64>();
            if !sum.is_finite() {
                let pointer = format!("/layers/{place}/weights/{row}");
                let message = "the sum of these weights may be beyond 64-bit numbers";
                findings.report(Finding::at(module.file("module.json"), pointer, message));
            }
        }
        largest = vec![1.0; layer.biases.len()];
    }
}
