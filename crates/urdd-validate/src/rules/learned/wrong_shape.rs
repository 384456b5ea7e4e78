use super::subject;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::learned::network;
use crate::rule::declare_rule;

declare_rule! {
    /// A list of the self-collision model is of another length than the layer, the pairs or the DOFs ask for.
    ///
    /// The network cannot be evaluated, or not as it was trained.
    ///
    /// A row of `weights` has one number for each value of the layer before (the first: for each number that the inputs
    /// give), `biases` one for each row, the last layer one row for each of `pairs`; a test vector has a value for
    /// each DOF and a clearance for each pair. Nothing of it is empty.
    LRN003 "model-shape-wrong", Error, clause "8.8.4", since "0.2.0",
    phase References, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::Dof), ROBOT_SOUND, NotFailed(DOF003),
        NotFailed(LRN001), NotFailed(LRN002),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some((module, model)), Some(dofs)) = (subject(context), context.dofs()) else {
        return;
    };
    let mut judge = |pointer: String, what: &str, expected: usize, actual: usize| {
        if expected != actual || actual == 0 {
            let message = format!("there must be {what}, and at least one");
            let finding = Finding::at(module.file("module.json"), pointer, message);
            findings.report(finding.expected(expected).actual(actual));
        }
        expected == actual && actual > 0
    };
    let widths: usize = model.inputs.iter().map(network::width).sum();
    if !judge("/inputs".to_owned(), "inputs", widths, widths) {
        return;
    }
    let mut width = widths;
    let layers = model.layers.len();
    judge("/layers".to_owned(), "layers", layers, layers);
    for (place, layer) in model.layers.iter().enumerate() {
        let at = |rest: String| format!("/layers/{place}/{rest}");
        let rows = layer.weights.len();
        let wrong = layer.weights.iter().position(|row| row.len() != width);
        if let Some(row) = wrong {
            let what = "one number for each value before";
            judge(
                at(format!("weights/{row}")),
                what,
                width,
                layer.weights[row].len(),
            );
        }
        let wanted = match place + 1 == layers {
            true => model.pairs.len(),
            false => rows,
        };
        judge(
            at("weights".to_owned()),
            "one row for each value of the layer",
            wanted,
            rows,
        );
        judge(
            at("biases".to_owned()),
            "one bias for each row",
            rows,
            layer.biases.len(),
        );
        width = rows;
    }
    let vectors = model.test_vectors.len();
    judge("/test_vectors".to_owned(), "test vectors", vectors, vectors);
    for (place, vector) in model.test_vectors.iter().enumerate() {
        let at = |key: &str| format!("/test_vectors/{place}/{key}");
        let (values, clearances) = (vector.configuration.len(), vector.clearances.len());
        judge(
            at("configuration"),
            "one value for each DOF",
            dofs.num_dofs.get(),
            values,
        );
        judge(
            at("clearances"),
            "one clearance for each pair",
            model.pairs.len(),
            clearances,
        );
    }
}
