//! `dof_module` from the robot, SPEC 6.2, and `bounds_module` from both, SPEC 6.5.

use std::f64::consts::PI;

use urdd_format::bounds::BoundsModule;
use urdd_format::dof::{Dof, DofModule, Quantity, ResolvedMimic};
use urdd_format::index::{Count, DofIdx, JointIdx};
use urdd_format::urdf::{JointType, UrdfModule};
use urdd_source::fault::Fault;
use urdd_source::urdf::Tree;

/// The name suffix and the quantity of each DOF of a joint (SPEC 5.8).
fn dofs_of(joint_type: JointType) -> Vec<(&'static str, Quantity)> {
    use Quantity::{Angle, Length};
    let translations = [("/trans_x", Length), ("/trans_y", Length), ("/trans_z", Length)];
    let rotations = [("/rot_x", Angle), ("/rot_y", Angle), ("/rot_z", Angle)];
    match joint_type {
        JointType::Fixed => Vec::new(),
        JointType::Revolute | JointType::Continuous => vec![("", Angle)],
        JointType::Prismatic => vec![("", Length)],
        JointType::Planar => [&translations[..2], &[("/rot", Angle)]].concat(),
        JointType::Floating => [translations, rotations].concat(),
        JointType::Spherical => rotations.to_vec(),
    }
}

/// Builds the module.
/// Fails if the multipliers or offsets along a chain of mimic joints overflow binary64.
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
        joint_to_dofs.push((first..dofs.len()).map(|dof| DofIdx(dof as u32)).collect::<Vec<_>>());
    }
    let mimics = resolve(robot, tree, &joint_to_dofs)?;
    Ok(DofModule {
        num_dofs: Count(dofs.len() as u32),
        dof_idx_to_joint_idx_mapping: dofs.iter().map(|dof| dof.joint_idx).collect(),
        joint_idx_to_dof_idxs_mapping: joint_to_dofs,
        joint_idx_to_mimic_mapping: mimics,
        dofs,
    })
}

/// Follows chains of mimic joints to a joint that is not a mimic joint, or is fixed (SPEC 5.10).
fn resolve(
    robot: &UrdfModule,
    tree: &Tree,
    joint_to_dofs: &[Vec<DofIdx>],
) -> Result<Vec<Option<ResolvedMimic>>, Fault> {
    let is_fixed = |idx: usize| robot.joints[idx].joint_type == JointType::Fixed;
    let mut resolved: Vec<Option<ResolvedMimic>> = vec![None; robot.joints.len()];
    for start in 0..robot.joints.len() {
        let mut chain = Vec::new();
        let mut end = start;
        while let (Some(mimic), false, None) =
            (&robot.joints[end].mimic, is_fixed(end), &resolved[end])
        {
            chain.push((end, mimic));
            match tree.drivers[end] {
                Some(driver) => end = driver,
                None => break,
            }
        }
        let mut driver = resolved[end].clone().unwrap_or(ResolvedMimic {
            dof_idx: joint_to_dofs[end].first().copied(),
            multiplier: 1.0,
            offset: 0.0,
        });
        // From the far end of the chain: m1 (m2 q + o2) + o1 is (m1 m2) q + (m1 o2 + o1).
        for (idx, mimic) in chain.into_iter().rev() {
            let multiplier = mimic.multiplier.unwrap_or(1.0);
            let offset = mimic.offset.unwrap_or(0.0);
            driver = ResolvedMimic {
                dof_idx: driver.dof_idx,
                multiplier: multiplier * driver.multiplier,
                offset: multiplier * driver.offset + offset,
            };
            if !(driver.multiplier.is_finite() && driver.offset.is_finite()) {
                return Err(Fault::MimicOverflow((&*robot.joints[idx].name).into()));
            }
            resolved[idx] = Some(driver.clone());
        }
    }
    Ok(resolved)
}

pub(super) fn bounds_module(robot: &UrdfModule, dof: &DofModule) -> BoundsModule {
    let mut module = BoundsModule {
        bounds: Vec::new(),
        dof_lower_bounds: Vec::new(),
        dof_upper_bounds: Vec::new(),
        dof_limited: Vec::new(),
        dof_velocity_limits: Vec::new(),
        dof_effort_limits: Vec::new(),
    };
    for dof in &dof.dofs {
        let joint = &robot.joints[dof.joint_idx.get()];
        let limit = joint.limit.as_ref();
        let kind = joint.joint_type;
        let can_be_limited = matches!(kind, JointType::Revolute | JointType::Prismatic);
        let written = limit
            .filter(|limit| can_be_limited && (limit.lower.is_some() || limit.upper.is_some()));
        let [lower, upper] = match (written, dof.quantity) {
            (Some(limit), _) => [limit.lower.unwrap_or(0.0), limit.upper.unwrap_or(0.0)],
            (None, Quantity::Angle) => [-PI, PI],
            (None, Quantity::Length) => [-1.0, 1.0],
        };
        let of_one_dof = limit.filter(|_| can_be_limited || kind == JointType::Continuous);
        module.bounds.push([lower, upper]);
        module.dof_lower_bounds.push(lower);
        module.dof_upper_bounds.push(upper);
        module.dof_limited.push(written.is_some());
        let velocity = of_one_dof.and_then(|limit| limit.velocity);
        let effort = of_one_dof.and_then(|limit| limit.effort);
        module.dof_velocity_limits.push(velocity);
        module.dof_effort_limits.push(effort);
    }
    module
}
