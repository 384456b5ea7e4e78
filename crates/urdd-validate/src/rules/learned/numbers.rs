use crate::reference::learned;
use crate::rules::prelude::*;
use urdd_format::dof::Quantity;
use urdd_format::index::{DofIdx, LinkIdx};
use urdd_format::self_collision_model::ModelInput;

declare_rule! {
    /// `self_collision_model_module` names a DOF or a link that is not there, or its pairs are out of order.
    ///
    /// A program that looks up the pair of a clearance finds nothing, or another one. Each pair stands once, in
    /// `pairs` or in `other_pairs`, with the lower link first; both lists ascend.
    ///
    /// Train the model again, on the robot as it is now: `urdd generate --modules all,self_collision_model`.
    LRN001 "model-index-out-of-range", Error, clause "8.8.2", since "0.2.0",
    phase References, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::Dof), ROBOT_SOUND, NotFailed(DOF003),
    ], check index_out_of_range,

    /// An input of the self-collision model is not of a DOF of its kind.
    ///
    /// An angle comes in as sines and cosines, a length as a part of a range, a rotation vector as its matrix. For
    /// another kind of DOF these numbers mean something other than what the network was trained on, or leave out what
    /// moves links.
    ///
    /// Give each DOF at most once, by its `quantity` in `dof_module`; the three of a rotation vector (SPEC 5.8) in one
    /// `RotationVector`, in their order; and to a `Length` a positive `half_range`.
    LRN002 "model-input-wrong", Error, clause "8.8.3", since "0.2.0",
    phase References, needs [
        Version1, Module(Kind::SelfCollisionModel), ModuleV1(Kind::Dof), Module(Kind::Chain), ROBOT_SOUND,
        NoneFailed(&[DOF003, DOF004, DOF005, DOF007, LRN001]),
    ], check input_wrong,

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

fn index_out_of_range(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let robot = context.robot()?;
    let dofs = context.dofs()?;
    let num_dofs = dofs.num_dofs.get();
    let mut judge = |pointer: String, what: &str, index: usize, count: usize| {
        if index >= count {
            finding_in(Kind::SelfCollisionModel, pointer, format!("there is no such {what}"))
                .values(format!("below {count}"), index)
                .report(findings);
        }
    };
    let mut dof = |pointer, idx: DofIdx| judge(pointer, "DOF", idx.get(), num_dofs);
    for (place, input) in model.inputs.iter().enumerate() {
        let at = |rest: &str| format!("/inputs/{place}/{rest}");
        match input {
            ModelInput::Angle(of) => dof(at("Angle/dof_idx"), of.dof_idx),
            ModelInput::Length(of) => dof(at("Length/dof_idx"), of.dof_idx),
            ModelInput::RotationVector(of) => {
                for (k, idx) in of.dof_idxs.into_iter().enumerate() {
                    dof(at(&format!("RotationVector/dof_idxs/{k}")), idx);
                }
            }
        }
    }
    let outputs = model.pairs.iter();
    let outputs: Vec<[LinkIdx; 2]> = outputs.map(|of| [of.link_a_idx, of.link_b_idx]).collect();
    let others = model.other_pairs.iter();
    let others: Vec<[LinkIdx; 2]> = others.map(|of| [of.link_a_idx, of.link_b_idx]).collect();
    let num_links = robot.links.len();
    for (list, pairs) in [("pairs", &outputs), ("other_pairs", &others)] {
        for (place, [a, b]) in pairs.iter().enumerate() {
            let at = |key: &str| format!("/{list}/{place}/{key}");
            judge(at("link_a_idx"), "link", a.get(), num_links);
            judge(at("link_b_idx"), "link", b.get(), num_links);
        }
    }
    for (list, pairs) in [("pairs", &outputs), ("other_pairs", &others)] {
        let turned = pairs.iter().position(|[a, b]| a >= b);
        let disordered = pairs.windows(2).position(|two| two[0] >= two[1]);
        let fault = match (turned, disordered) {
            (Some(place), _) => Some((place, "the lower link comes first")),
            (_, Some(place)) => Some((place + 1, "ascending pairs, each once")),
            _ => None,
        };
        if let Some((place, expected)) = fault {
            let message = "this pair is out of order";
            let finding = finding_in(Kind::SelfCollisionModel, format!("/{list}/{place}"), message);
            findings.report(finding.expected(expected));
            return Some(());
        }
    }
    if let Some(place) = others.iter().position(|pair| outputs.contains(pair)) {
        let message = "this pair is also in `pairs`";
        let finding =
            finding_in(Kind::SelfCollisionModel, format!("/other_pairs/{place}"), message);
        findings.report(finding);
    }
    Some(())
}

fn input_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let robot = context.robot()?;
    let dof = document!(context, Dof)?;
    let mut vectors: Vec<[usize; 3]> = Vec::new();
    for (joint, dofs) in robot.joints.iter().zip(&dof.joint_idx_to_dof_idxs_mapping) {
        let is_vector = matches!(joint.joint_type, JointType::Floating | JointType::Spherical);
        let dofs: Vec<usize> = dofs.iter().map(|dof| dof.get()).collect();
        vectors.extend(dofs.last_chunk().filter(|_| is_vector));
    }
    let is = |at: usize, quantity: Quantity| {
        let stated = dof.dofs.get(at).map(|dof| &dof.quantity);
        stated == Some(&quantity)
    };
    let mut seen: BTreeSet<usize> = BTreeSet::new();
    for (place, input) in model.inputs.iter().enumerate() {
        let (key, dofs, fits, expected) = match input {
            ModelInput::Angle(of) => {
                let at = of.dof_idx.get();
                let fits = is(at, Quantity::Angle) && !vectors.iter().any(|of| of.contains(&at));
                let expected = "an angle that is not part of a rotation vector";
                ("Angle", vec![at], fits, expected)
            }
            ModelInput::Length(of) => {
                let at = of.dof_idx.get();
                let fits = is(at, Quantity::Length) && of.half_range > 0.0;
                let expected = "a length, and a positive half_range";
                ("Length", vec![at], fits, expected)
            }
            ModelInput::RotationVector(of) => {
                let dofs = of.dof_idxs.map(|dof| dof.get());
                let expected = "the three DOFs of one rotation vector, in their order";
                let fits = vectors.contains(&dofs);
                ("RotationVector", dofs.to_vec(), fits, expected)
            }
        };
        let message = match fits {
            false => "the DOFs of this input are not of its kind",
            true if dofs.iter().any(|dof| seen.contains(dof)) => "this DOF is already an input",
            true => {
                seen.extend(dofs);
                continue;
            }
        };
        let finding =
            finding_in(Kind::SelfCollisionModel, format!("/inputs/{place}/{key}"), message);
        findings.report(finding.expected(expected));
    }
    Some(())
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
    let mut width: usize = model.inputs.iter().map(learned::width).sum();
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
