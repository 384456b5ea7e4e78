use crate::rules::prelude::*;
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
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
