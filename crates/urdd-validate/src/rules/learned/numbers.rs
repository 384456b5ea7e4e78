use crate::reference::learned::network;
use crate::rules::prelude::*;
use urdd_format::self_collision_model::ModelInput;

declare_rule! {
    /// A list of the self-collision model does not have the length that the layer, the pairs or the DOFs require.
    ///
    /// The network cannot be evaluated, or not as it was trained.
    ///
    /// A row of `weights` has one number for each value of the layer before (the first: for each number that the inputs
    /// give), `biases` one for each row, the last layer one row for each of `pairs`; a test vector has a value for each
    /// DOF and a clearance for each pair. No list is empty.
    LRN003 "model-shape-wrong", Error, clause "8.8.4", since "0.2.0",
    phase References, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::Dof), ROBOT_SOUND, NoneFailed(&[DOF003, LRN001, LRN002]),
    ], check wrong_shape,

    /// The numbers of a layer of the self-collision model are so large that their sum may be beyond 64-bit numbers.
    ///
    /// Such a sum is infinite, or not a number (NaN), and comparisons with it can make the model clear every
    /// configuration.
    ///
    /// Train the model again, with weights that stay small.
    LRN004 "model-overflows", Error, clause "8.8.4", since "0.2.0",
    phase References, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::Bounds), NoneFailed(&[BND001, LRN001, LRN002, LRN003]),
    ], check overflow,

    /// The self-collision model is larger than a model may be.
    ///
    /// A model is worth having where it is faster than the exact check that it replaces. One that is padded with
    /// weights also makes it costly to count its collisions again.
    ///
    /// At most 65,536 weights and biases, and 100 test vectors. Train a smaller network.
    LRN005 "model-too-large", Error, clause "8.8.4", since "0.2.0",
    phase References, needs [Version1, Module(Kind::SelfCollisionModel)], check too_large,
}

fn wrong_shape(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let num_dofs = context.dofs()?.num_dofs.get();
    let mut judge = |pointer: String, what: &str, expected: usize, actual: usize| {
        let right = expected == actual && actual > 0;
        if !right {
            let message = format!("there must be {what}, and at least one");
            let finding = finding_in(Kind::SelfCollisionModel, pointer, message);
            findings.report(finding.values(expected, actual));
        }
        right
    };
    let mut width: usize = model.inputs.iter().map(network::width).sum();
    if !judge("/inputs".to_owned(), "inputs", width, width) {
        return Some(());
    }
    let layers = model.layers.len();
    judge("/layers".to_owned(), "layers", layers, layers);
    for (place, layer) in model.layers.iter().enumerate() {
        let at = |rest: &str| format!("/layers/{place}/{rest}");
        let (rows, biases) = (layer.weights.len(), layer.biases.len());
        let mut lengths = layer.weights.iter().map(Vec::len).enumerate();
        if let Some((row, length)) = lengths.find(|(_, length)| *length != width) {
            let what = "one number for each value before";
            judge(at(&format!("weights/{row}")), what, width, length);
        }
        let wanted = if place + 1 == layers { model.pairs.len() } else { rows };
        let what = "one row for each value of the layer";
        judge(at("weights"), what, wanted, rows);
        judge(at("biases"), "one bias for each row", rows, biases);
        width = rows;
    }
    let vectors = model.test_vectors.len();
    judge("/test_vectors".to_owned(), "test vectors", vectors, vectors);
    for (place, vector) in model.test_vectors.iter().enumerate() {
        let at = |key: &str| format!("/test_vectors/{place}/{key}");
        let (values, clearances) = (vector.configuration.len(), vector.clearances.len());
        let what = "one value for each DOF";
        judge(at("configuration"), what, num_dofs, values);
        let what = "one clearance for each pair";
        judge(at("clearances"), what, model.pairs.len(), clearances);
    }
    Some(())
}

fn overflow(context: &Context, findings: &mut Findings) -> Option<()> {
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

/// Maximum number of weights and biases.
const MAX_NUMBERS: usize = 65_536;
/// Maximum number of test vectors.
const MAX_VECTORS: usize = 100;

fn too_large(context: &Context, findings: &mut Findings) -> Option<()> {
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
