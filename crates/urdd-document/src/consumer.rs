//! The modules that a consumer computes kinematics from: `chain_module` and `dof_module`. In legacy URDDs, only
//! `urdf_module` has origins and axes.

use crate::robot::Robot;
use crate::urdd::Urdd;
use urdd_format::chain::{ChainModule, JointInChain, LinkInChain};
use urdd_format::dof::{Dof, DofModule, Quantity, ResolvedMimic};
use urdd_format::index::{DofIdx, JointIdx};
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
    let (chain, dofs) = (urdd.chain()?, urdd.dofs()?);
    if let (Some(chain), Some(dof)) = (chain.v1, dofs.v1) {
        return Some(ConsumerModules { chain: chain.clone(), dof: dof.clone() });
    }
    let robot = urdd.robot()?;
    let links_in_chain = chain.links.iter().map(|link| LinkInChain {
        name: link.name.to_owned(),
        link_idx: link.link_idx,
        parent_joint_idx: link.parent_joint_idx,
        parent_link_idx: link.parent_link_idx,
        children_joint_idxs: link.children_joint_idxs.to_vec(),
        children_link_idxs: link.children_link_idxs.to_vec(),
    });
    let joints_in_chain = chain.joints.iter().zip(&robot.joints).map(|(joint, source)| {
        let [x, y, z] = source.origin.xyz;
        let isometry = nalgebra::Isometry3::from_parts(
            nalgebra::Translation3::new(x, y, z),
            rotation::from_rpy(source.origin.rpy),
        );
        JointInChain {
            joint_name: joint.joint_name.to_owned(),
            joint_idx: joint.joint_idx,
            parent_link_name: joint.parent_link_name.to_owned(),
            parent_link_idx: joint.parent_link_idx,
            child_link_name: joint.child_link_name.to_owned(),
            child_link_idx: joint.child_link_idx,
            joint_type: source.joint_type,
            origin: from_isometry(&isometry),
            axis: source
                .has_axis()
                .then(|| rotation::unit_axis(source.axis))
                .flatten()
                .map(|axis| [axis.x, axis.y, axis.z]),
        }
    });
    Some(ConsumerModules {
        chain: ChainModule {
            links_in_chain: links_in_chain.collect(),
            joints_in_chain: joints_in_chain.collect(),
            kinematic_hierarchy: chain.hierarchy.to_vec(),
            root_idx: chain.root,
        },
        dof: DofModule {
            num_dofs: dofs.num_dofs,
            dof_idx_to_joint_idx_mapping: dofs.joint_of_dof.to_vec(),
            joint_idx_to_dof_idxs_mapping: dofs.dofs_of_joint.to_vec(),
            joint_idx_to_mimic_mapping: legacy_mimics(urdd, robot, dofs.dofs_of_joint)?,
            dofs: dofs.joint_of_dof.iter().map(|joint| legacy_dof(robot, *joint)).collect(),
        },
    })
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
