use crate::rules::prelude::*;
use urdd_format::dof::Quantity;
use urdd_format::self_collision_model::ModelInput;

declare_rule! {
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
        NotFailed(DOF003), NotFailed(DOF004), NotFailed(DOF005), NotFailed(DOF007), NotFailed(LRN001),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
