use crate::rules::prelude::*;
use urdd_format::self_collision_model::ModelInput;

declare_rule! {
    /// The numbers of a layer of the self-collision model are so large that their sum may be beyond 64-bit numbers.
    ///
    /// Such a sum is infinite, or not a number (NaN), and comparisons with it can make the model clear every
    /// configuration.
    ///
    /// Train the model again, with weights that stay small.
    LRN004 "model-overflows", Error, clause "8.8.4", since "0.2.0",
    phase References, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::Bounds), NotFailed(BND001), NotFailed(LRN001),
        NotFailed(LRN002), NotFailed(LRN003),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let bounds = &context.bounds()?.bounds;
    let mut largest: Vec<f64> = Vec::new();
    for input in &model.inputs {
        match input {
            ModelInput::Angle(_) => largest.extend([1.0; 4]),
            ModelInput::RotationVector(_) => largest.extend([1.0; 9]),
            ModelInput::Length(of) => {
                let ends = bounds.get(of.dof_idx.get()).copied().unwrap_or_default();
                let far = ends.map(|end| ((end - of.middle) / of.half_range).abs());
                largest.push(far[0].max(far[1]));
            }
        }
    }
    for (place, layer) in model.layers.iter().enumerate() {
        for (row, (weights, bias)) in layer.weights.iter().zip(&layer.biases).enumerate() {
            let products = weights.iter().zip(&largest).map(|(w, x)| (w * x).abs());
            if !(bias.abs() + products.sum::<f64>()).is_finite() {
                let pointer = format!("/layers/{place}/weights/{row}");
                let message = "the sum of these weights may be beyond 64-bit numbers";
                finding_in(Kind::SelfCollisionModel, pointer, message).report(findings);
            }
        }
        largest = vec![1.0; layer.biases.len()];
    }
    Some(())
}
