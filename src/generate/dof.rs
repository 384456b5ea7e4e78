//! `dof_module` from the robot: SPEC 6.2.

use super::fault::Fault;
use super::urdf::Tree;
use crate::format::dof::{Dof, DofModule, Quantity, ResolvedMimic};
use crate::format::index::{Count, DofIdx, JointIdx};
use crate::format::urdf::{JointType, UrdfModule};

const TRANSLATIONS: [(&str, Quantity); 3] = [
    ("/trans_x", Quantity::Length),
    ("/trans_y", Quantity::Length),
    ("/trans_z", Quantity::Length),
];
const ROTATIONS: [(&str, Quantity); 3] = [
    ("/rot_x", Quantity::Angle),
    ("/rot_y", Quantity::Angle),
    ("/rot_z", Quantity::Angle),
];

/// What is added to the joint's name, and the quantity, of each DOF of a joint (SPEC 5.8).
fn dofs_of(joint_type: JointType) -> Vec<(&'static str, Quantity)> {
    match joint_type {
        JointType::Fixed => Vec::new(),
        JointType::Revolute | JointType::Continuous => vec![("", Quantity::Angle)],
        JointType::Prismatic => vec![("", Quantity::Length)],
        JointType::Planar => {
            let [x, y, _] = TRANSLATIONS;
            vec![x, y, ("/rot", Quantity::Angle)]
        }
        JointType::Floating => [TRANSLATIONS, ROTATIONS].concat(),
        JointType::Spherical => ROTATIONS.to_vec(),
    }
}

/// Makes the module.
///
/// # Errors
/// Where the multipliers along a chain of mimics are beyond 64-bit numbers.
pub(super) fn dof_module(robot: &UrdfModule, tree: &Tree) -> Result<DofModule, Fault> {
    let mut dofs = Vec::new();
    let mut joint_to_dofs = Vec::with_capacity(robot.joints.len());
    for (joint_idx, joint) in (0..).zip(&robot.joints) {
        let first = dofs.len();
        if joint.mimic.is_none() {
            for (suffix, quantity) in dofs_of(joint.joint_type) {
                dofs.push(Dof {
                    name: format!("{}{suffix}", joint.name),
                    joint_idx: JointIdx(joint_idx),
                    joint_name: joint.name.clone(),
                    quantity,
                });
            }
        }
        let own = (first..dofs.len()).map(|dof| DofIdx(dof as u32));
        joint_to_dofs.push(own.collect::<Vec<_>>());
    }
    let mimics = (0..robot.joints.len())
        .map(|idx| resolve(robot, tree, &joint_to_dofs, idx))
        .collect::<Result<_, _>>()?;
    Ok(DofModule {
        num_dofs: Count(dofs.len() as u32),
        dof_idx_to_joint_idx_mapping: dofs.iter().map(|dof| dof.joint_idx).collect(),
        joint_idx_to_dof_idxs_mapping: joint_to_dofs,
        joint_idx_to_mimic_mapping: mimics,
        dofs,
    })
}

/// SPEC 5.10: along the chain of mimics to the joint that moves by itself, or not at all.
fn resolve(
    robot: &UrdfModule,
    tree: &Tree,
    joint_to_dofs: &[Vec<DofIdx>],
    idx: usize,
) -> Result<Option<ResolvedMimic>, Fault> {
    let is_fixed = |idx: usize| robot.joints[idx].joint_type == JointType::Fixed;
    if robot.joints[idx].mimic.is_none() || is_fixed(idx) {
        return Ok(None);
    }
    let mut chain = Vec::new();
    let mut end = idx;
    while let (Some(mimic), false) = (&robot.joints[end].mimic, is_fixed(end)) {
        chain.push((mimic.multiplier.unwrap_or(1.0), mimic.offset.unwrap_or(0.0)));
        match tree.drivers[end] {
            Some(driver) => end = driver,
            None => break,
        }
    }
    // From the far end: m1 (m2 q + o2) + o1 is (m1 m2) q + (m1 o2 + o1).
    let (mut multiplier, mut offset) = (1.0, 0.0);
    for (m, o) in chain.into_iter().rev() {
        (multiplier, offset) = (m * multiplier, m * offset + o);
    }
    if !(f64::is_finite(multiplier) && f64::is_finite(offset)) {
        return Err(Fault::MimicOverflow(robot.joints[idx].name.clone()));
    }
    Ok(Some(ResolvedMimic {
        dof_idx: joint_to_dofs[end].first().copied(),
        multiplier,
        offset,
    }))
}
