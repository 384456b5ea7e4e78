use std::collections::BTreeSet;

use super::subject;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::dof::Quantity;
use urdd_format::self_collision_model::ModelInput;
use urdd_format::urdf::JointType;

declare_rule! {
    /// An input of the self-collision model is not of a DOF of its kind.
    ///
    /// An angle comes in as sines and cosines, a length as a part of a range, a rotation vector as its matrix. Of
    /// another kind of DOF these numbers say something else than the network was trained on, or leave out what
    /// moves links.
    ///
    /// Give each DOF at most once, by its `quantity` in `dof_module`; the three of a rotation vector (SPEC 5.8) in one
    /// `RotationVector`, in their order; and to a `Length` a positive `half_range`.
    LRN002 "model-input-wrong", Error, clause "8.8.3", since "0.2.0",
    phase References, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::Dof), Module(Kind::Chain), ROBOT_SOUND,
        NotFailed(DOF003), NotFailed(DOF004), NotFailed(DOF005), NotFailed(DOF007), NotFailed(LRN001),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some((module, model)), Some(robot)) = (subject(context), context.robot()) else {
        return;
    };
    let Some(dof) = context.dofs().and_then(|dofs| dofs.v1) else {
        return;
    };
    let turns = |dof: usize, of: &[usize]| of.contains(&dof);
    let mut vectors: Vec<[usize; 3]> = Vec::new();
    for (joint, dofs) in robot.joints.iter().zip(&dof.joint_idx_to_dof_idxs_mapping) {
        let is_vector = matches!(joint.joint_type, JointType::Floating | JointType::Spherical);
        let dofs: Vec<usize> = dofs.iter().map(|dof| dof.get()).collect();
        if let (true, Some(last)) = (is_vector, dofs.last_chunk()) {
            vectors.push(*last);
        }
    }
    let is_angle = |at: usize| {
        let own = dof.dofs.get(at).map(|dof| &dof.quantity);
        own == Some(&Quantity::Angle) && !vectors.iter().any(|vector| turns(at, vector))
    };
    let is_length = |at: usize| {
        let own = dof.dofs.get(at).map(|dof| &dof.quantity);
        own == Some(&Quantity::Length)
    };
    let mut seen: BTreeSet<usize> = BTreeSet::new();
    for (place, input) in model.inputs.iter().enumerate() {
        let (key, dofs, fits, expected) = match input {
            ModelInput::Angle(of) => {
                let at = of.dof_idx.get();
                let expected = "an angle that is no part of a rotation vector";
                ("Angle", vec![at], is_angle(at), expected)
            }
            ModelInput::Length(of) => {
                let at = of.dof_idx.get();
                let fits = is_length(at) && of.half_range > 0.0;
                (
                    "Length",
                    vec![at],
                    fits,
                    "a length, and a positive half_range",
                )
            }
            ModelInput::RotationVector(of) => {
                let dofs = of.dof_idxs.map(|dof| dof.get());
                let expected = "the three DOFs of one rotation vector, in their order";
                let fits = vectors.contains(&dofs);
                ("RotationVector", dofs.to_vec(), fits, expected)
            }
        };
        let message = match fits {
            false => "this input is not of DOFs of its kind",
            true if dofs.iter().any(|dof| seen.contains(dof)) => "this DOF is an input already",
            true => {
                seen.extend(dofs);
                continue;
            }
        };
        let finding = Finding::at(
            module.file("module.json"),
            format!("/inputs/{place}/{key}"),
            message,
        );
        findings.report(finding.expected(expected));
    }
}
