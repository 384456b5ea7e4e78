//! The modules that a consumer computes kinematics from: `chain_module` and `dof_module`. In legacy URDDs, only
//! `urdf_module` has origins and axes.

use nalgebra::{Isometry3, Translation3};

use crate::robot::Robot;
use crate::urdd::Urdd;
use urdd_format::chain::ChainModule;
use urdd_format::dof::{Dof, DofModule, Quantity, ResolvedMimic};
use urdd_format::index::{DofIdx, JointIdx};
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::JointType;
use urdd_kinematics::pose::from_isometry;
use urdd_kinematics::rotation;

/// The two modules that a consumer computes poses from.
pub struct ConsumerModules {
    /// The kinematic tree.
    pub chain: ChainModule,
    /// The degrees of freedom.
    pub dof: DofModule,
}

/// The modules of a URDD in the form of version 1. `None` if one is missing, or if legacy modules are incomplete.
pub fn modules(urdd: &Urdd) -> Option<ConsumerModules> {
    let mut modules = ConsumerModules { chain: urdd.chain()?.clone(), dof: urdd.dofs()?.clone() };
    if !urdd.is_legacy(ModuleKind::Chain) && !urdd.is_legacy(ModuleKind::Dof) {
        return Some(modules);
    }
    let robot = urdd.robot()?;
    let joints = &mut modules.chain.joints_in_chain;
    joints.truncate(robot.joints.len());
    for (joint, source) in joints.iter_mut().zip(&robot.joints) {
        let axis = rotation::unit_axis(source.axis).filter(|_| source.has_axis());
        joint.joint_type = source.joint_type;
        joint.origin = from_isometry(&Isometry3::from_parts(
            Translation3::from(source.origin.xyz),
            rotation::from_rpy(source.origin.rpy),
        ));
        joint.axis = axis.map(|axis| [axis.x, axis.y, axis.z]);
    }
    let dof = &mut modules.dof;
    dof.joint_idx_to_mimic_mapping =
        legacy_mimics(urdd, robot, &dof.joint_idx_to_dof_idxs_mapping)?;
    let joints = dof.dof_idx_to_joint_idx_mapping.iter();
    dof.dofs = joints.map(|joint| legacy_dof(robot, *joint)).collect();
    Some(modules)
}

/// The mimics of `urdf_module`. A mimic joint with its own DOF (`dof_module` 0.0.1) follows that DOF.
fn legacy_mimics(
    urdd: &Urdd,
    robot: &Robot,
    dofs_of_joint: &[Vec<DofIdx>],
) -> Option<Vec<Option<ResolvedMimic>>> {
    let mimics = urdd.mimics()?;
    let resolve = |joint: usize| {
        let resolved = mimics.by_joint[joint]?;
        let own = dofs_of_joint.get(joint).is_some_and(|dofs| !dofs.is_empty());
        (!own).then(|| ResolvedMimic {
            dof_idx: dofs_of_joint.get(resolved.driver).and_then(|dofs| dofs.first().copied()),
            multiplier: resolved.multiplier,
            offset: resolved.offset,
        })
    };
    Some((0..robot.joints.len()).map(resolve).collect())
}

fn legacy_dof(robot: &Robot, joint: JointIdx) -> Dof {
    let source = robot.joints.get(joint.get());
    let slides = source.is_some_and(|joint| joint.joint_type == JointType::Prismatic);
    let name = source.map(|joint| joint.name.clone()).unwrap_or_default();
    Dof {
        name: name.clone(),
        joint_idx: joint,
        joint_name: name,
        quantity: if slides { Quantity::Length } else { Quantity::Angle },
    }
}
