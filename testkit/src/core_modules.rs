//! Builds chain and DOF modules for tests, independently of the generator.
#![allow(dead_code)] // Each test crate uses a part.

use urdd_format::chain::{ChainModule, JointInChain, LinkInChain};
use urdd_format::dof::{Dof, DofModule, Quantity, ResolvedMimic};
use urdd_format::index::{Count, DofIdx, JointIdx, LinkIdx};
use urdd_format::pose::Pose;
use urdd_format::urdf::JointType;

/// A joint as in a URDF, with its mimic resolved.
#[derive(Debug, Clone)]
pub struct Joint {
    pub name: String,
    pub joint_type: JointType,
    pub parent: usize,
    pub child: usize,
    pub xyz: [f64; 3],
    pub rpy: [f64; 3],
    /// Not normalised.
    pub axis: [f64; 3],
    pub mimic: Option<ResolvedMimic>,
}

impl Joint {
    /// A joint from link `parent` to the next link, at the parent's origin.
    pub fn after(parent: usize, joint_type: JointType, axis: [f64; 3]) -> Self {
        Joint {
            name: format!("joint_{parent}"),
            joint_type,
            parent,
            child: parent + 1,
            xyz: [0.0; 3],
            rpy: [0.0; 3],
            axis,
            mimic: None,
        }
    }

    pub fn at(self, xyz: [f64; 3], rpy: [f64; 3]) -> Self {
        Joint { xyz, rpy, ..self }
    }

    pub fn follows(self, dof: Option<u32>, multiplier: f64, offset: f64) -> Self {
        let dof_idx = dof.map(DofIdx);
        let mimic = Some(ResolvedMimic { dof_idx, multiplier, offset });
        Joint { mimic, ..self }
    }
}

pub fn dof_count(joint: &Joint) -> u32 {
    match joint.joint_type {
        _ if joint.mimic.is_some() => 0,
        JointType::Fixed => 0,
        JointType::Revolute | JointType::Continuous | JointType::Prismatic => 1,
        JointType::Planar | JointType::Spherical => 3,
        JointType::Floating => 6,
    }
}

/// The first DOF of each joint.
pub fn first_dofs(joints: &[Joint]) -> Vec<u32> {
    let mut next = 0;
    let mut first = Vec::new();
    for joint in joints {
        first.push(next);
        next += dof_count(joint);
    }
    first
}

/// Unit quaternion (w, x, y, z) of Rz(yaw) Ry(pitch) Rx(roll).
fn quaternion(rpy: [f64; 3]) -> [f64; 4] {
    let [(sr, cr), (sp, cp), (sy, cy)] = rpy.map(|angle| (angle / 2.0).sin_cos());
    [
        cy * cp * cr + sy * sp * sr,
        cy * cp * sr - sy * sp * cr,
        cy * sp * cr + sy * cp * sr,
        sy * cp * cr - cy * sp * sr,
    ]
}

pub fn unit(v: [f64; 3]) -> [f64; 3] {
    let norm = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|x| x / norm)
}

/// The two modules of a robot with these links and joints.
pub fn core_modules(links: &[String], joints: &[Joint]) -> (ChainModule, DofModule) {
    (chain_module(links, joints), dof_module(joints))
}

/// The two modules of a robot without branches: link i + 1 is a child of link i.
pub fn chain_of(joints: &[Joint]) -> (ChainModule, DofModule) {
    let links: Vec<String> = (0..=joints.len()).map(|i| format!("link_{i}")).collect();
    core_modules(&links, joints)
}

fn chain_module(links: &[String], joints: &[Joint]) -> ChainModule {
    let above = |link: usize| joints.iter().position(|joint| joint.child == link);
    let below =
        |link: usize| joints.iter().enumerate().filter(move |(_, joint)| joint.parent == link);
    let root = (0..links.len()).find(|link| above(*link).is_none()).unwrap();
    let mut hierarchy = vec![vec![LinkIdx(root as u32)]];
    while let Some(level) = hierarchy.last().filter(|level| !level.is_empty()) {
        let links = level.iter().flat_map(|link| below(link.get()));
        let mut next: Vec<LinkIdx> = links.map(|(_, joint)| LinkIdx(joint.child as u32)).collect();
        next.sort();
        hierarchy.push(next);
    }
    hierarchy.pop();
    ChainModule {
        links_in_chain: (0..links.len())
            .map(|link| LinkInChain {
                name: links[link].clone(),
                link_idx: LinkIdx(link as u32),
                parent_joint_idx: above(link).map(|joint| JointIdx(joint as u32)),
                parent_link_idx: above(link).map(|joint| LinkIdx(joints[joint].parent as u32)),
                children_joint_idxs: below(link).map(|(idx, _)| JointIdx(idx as u32)).collect(),
                children_link_idxs: below(link)
                    .map(|(_, joint)| LinkIdx(joint.child as u32))
                    .collect(),
            })
            .collect(),
        joints_in_chain: joints
            .iter()
            .enumerate()
            .map(|(idx, joint)| JointInChain {
                joint_name: joint.name.clone(),
                joint_idx: JointIdx(idx as u32),
                parent_link_name: links[joint.parent].clone(),
                parent_link_idx: LinkIdx(joint.parent as u32),
                child_link_name: links[joint.child].clone(),
                child_link_idx: LinkIdx(joint.child as u32),
                joint_type: joint.joint_type,
                origin: Pose { position: joint.xyz, quaternion_wxyz: quaternion(joint.rpy) },
                axis: match joint.joint_type {
                    JointType::Fixed | JointType::Floating | JointType::Spherical => None,
                    _ => Some(unit(joint.axis)),
                },
            })
            .collect(),
        kinematic_hierarchy: hierarchy,
        root_idx: LinkIdx(root as u32),
    }
}

fn dof_module(joints: &[Joint]) -> DofModule {
    let mut dofs = Vec::new();
    let mut of_joints = Vec::new();
    for (idx, joint) in joints.iter().enumerate() {
        let first = dofs.len() as u32;
        of_joints.push((first..first + dof_count(joint)).map(DofIdx).collect());
        dofs.extend((0..dof_count(joint)).map(|i| Dof {
            name: format!("{}/{i}", joint.name),
            joint_idx: JointIdx(idx as u32),
            joint_name: joint.name.clone(),
            quantity: match (joint.joint_type, i) {
                (JointType::Prismatic, _)
                | (JointType::Planar, 0 | 1)
                | (JointType::Floating, 0..=2) => Quantity::Length,
                _ => Quantity::Angle,
            },
        }));
    }
    DofModule {
        num_dofs: Count(dofs.len() as u32),
        dof_idx_to_joint_idx_mapping: dofs.iter().map(|dof| dof.joint_idx).collect(),
        joint_idx_to_dof_idxs_mapping: of_joints,
        joint_idx_to_mimic_mapping: joints.iter().map(|joint| joint.mimic.clone()).collect(),
        dofs,
    }
}
