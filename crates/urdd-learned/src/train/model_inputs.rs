//! The network's inputs: the DOFs that move the links of a pair relative to each other.

use std::collections::BTreeSet;

use super::subject::{NoModel, Subject, rounded};
use urdd_format::dof::Quantity;
use urdd_format::escape;
use urdd_format::index::DofIdx;
use urdd_format::self_collision_model::{AngleInput, LengthInput, ModelInput, RotationVectorInput};
use urdd_format::urdf::JointType;

/// # Errors
/// If a length among them has no limits.
pub(super) fn model_inputs(subject: &Subject) -> Result<Vec<ModelInput>, NoModel> {
    let pairs = subject.pairs.bodies();
    let dofs: BTreeSet<usize> =
        pairs.flat_map(|[a, b]| subject.kinematics.dofs_between(a, b)).collect();
    let mut inputs = Vec::new();
    let mut turned: BTreeSet<usize> = BTreeSet::new();
    for dof in dofs {
        let of = &subject.dof.dofs[dof];
        let joint = of.joint_idx.get();
        let dof_idx = DofIdx(u32::try_from(dof).unwrap_or(u32::MAX));
        match (of.quantity, subject.chain.joints_in_chain[joint].joint_type) {
            (Quantity::Length, JointType::Floating | JointType::Planar) => {
                let name = escape::line(&of.name);
                let useless = format!("DOF `{name}` is a length without limits");
                return Err(NoModel::OfNoUse(useless));
            }
            (Quantity::Length, _) => {
                let [lower, upper] = subject.space.bounds()[dof];
                let half_range = rounded(0.5 * (upper - lower).abs());
                inputs.push(ModelInput::Length(LengthInput {
                    dof_idx,
                    middle: rounded(0.5 * lower + 0.5 * upper),
                    half_range: if half_range > 0.0 { half_range } else { 1.0 },
                }));
            }
            (Quantity::Angle, JointType::Floating | JointType::Spherical) => {
                let dofs = &subject.dof.joint_idx_to_dof_idxs_mapping[joint];
                if let (true, Some(dof_idxs)) = (turned.insert(joint), dofs.last_chunk()) {
                    let dof_idxs = *dof_idxs;
                    inputs.push(ModelInput::RotationVector(RotationVectorInput { dof_idxs }));
                }
            }
            (Quantity::Angle, _) => inputs.push(ModelInput::Angle(AngleInput { dof_idx })),
        }
    }
    Ok(inputs)
}
