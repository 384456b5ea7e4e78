//! `chain_module` from the robot: SPEC 6.3.

use urdd_format::chain::{ChainModule, JointInChain, LinkInChain};
use urdd_format::index::{JointIdx, LinkIdx};
use urdd_format::urdf::UrdfModule;
use urdd_kinematics::has_axis;
use urdd_kinematics::pose::from_isometry;
use urdd_kinematics::rotation::unit_axis;
use urdd_source::origin;
use urdd_source::urdf::{Tree, written_axis};

pub fn chain_module(robot: &UrdfModule, tree: &Tree) -> ChainModule {
    let mut links: Vec<LinkInChain> = (0..)
        .zip(&robot.links)
        .map(|(idx, link)| LinkInChain {
            name: link.name.clone(),
            link_idx: LinkIdx(idx),
            parent_joint_idx: None,
            parent_link_idx: None,
            children_joint_idxs: Vec::new(),
            children_link_idxs: Vec::new(),
        })
        .collect();
    let quaternions = origin::has_quaternions(robot.version.as_deref());
    let mut joints = Vec::with_capacity(robot.joints.len());
    for ((joint_idx, joint), [parent, child]) in (0..).zip(&robot.joints).zip(&tree.ends) {
        let joint_idx = JointIdx(joint_idx);
        let [parent_idx, child_idx] = [parent, child].map(|link| LinkIdx(*link as u32));
        links[*parent].children_joint_idxs.push(joint_idx);
        links[*parent].children_link_idxs.push(child_idx);
        links[*child].parent_joint_idx = Some(joint_idx);
        links[*child].parent_link_idx = Some(parent_idx);
        let axis = unit_axis(written_axis(joint)).filter(|_| has_axis(joint.joint_type));
        joints.push(JointInChain {
            joint_name: joint.name.clone(),
            joint_idx,
            parent_link_name: joint.parent.link.clone(),
            parent_link_idx: parent_idx,
            child_link_name: joint.child.link.clone(),
            child_link_idx: child_idx,
            joint_type: joint.joint_type,
            origin: from_isometry(&origin::of(joint.origin.as_ref(), quaternions)),
            axis: axis.map(|axis| axis.into_inner().into()),
        });
    }
    for link in &mut links {
        // Joints are in order; their child links may not be.
        link.children_link_idxs.sort();
    }
    let kinematic_hierarchy = hierarchy(&links, tree.root);
    ChainModule {
        links_in_chain: links,
        joints_in_chain: joints,
        kinematic_hierarchy,
        root_idx: LinkIdx(tree.root as u32),
    }
}

fn hierarchy(links: &[LinkInChain], root: usize) -> Vec<Vec<LinkIdx>> {
    let mut levels = Vec::new();
    let mut level = vec![LinkIdx(root as u32)];
    while !level.is_empty() {
        let below = level.iter().flat_map(|link| &links[link.get()].children_link_idxs);
        let mut next: Vec<LinkIdx> = below.copied().collect();
        next.sort();
        levels.push(std::mem::replace(&mut level, next));
    }
    levels
}
