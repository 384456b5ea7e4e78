use crate::learned::network;
use crate::rules::prelude::*;

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
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::Dof), ROBOT_SOUND, NotFailed(DOF003),
        NotFailed(LRN001), NotFailed(LRN002),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
