//! The moving joints of a robot as unbranched chains.

use nalgebra::Isometry3;

use crate::structure::Structure;

/// Moving joints of one DOF in a row without a branch, or one of several DOFs.
pub(super) struct Chain {
    /// At least one, from the root outwards.
    pub joints: Vec<usize>,
    /// The link to which the first joint is attached.
    pub base: usize,
    /// The link that the last joint moves.
    pub last: usize,
    /// The chains that begin at its end.
    pub children: Vec<usize>,
    /// The farthest origin of a link after the first joint, m from it, in the default configuration.
    pub reach: f64,
}

/// All chains. A chain comes before those that begin at its end.
pub(super) struct Chains {
    pub all: Vec<Chain>,
    /// Those that begin at what is fixed to the root link.
    pub roots: Vec<usize>,
}

impl Chains {
    pub fn new(structure: &Structure, poses: &[Isometry3<f64>]) -> Self {
        let mut all: Vec<Chain> = Vec::new();
        let mut roots = Vec::new();
        let starts = |link: usize, parent: Option<usize>| {
            structure.joints_after(link).into_iter().rev().map(move |joint| (joint, parent))
        };
        let mut open: Vec<_> = starts(structure.tree.root, None).collect();
        while let Some((first, parent)) = open.pop() {
            let mut joints = vec![first];
            let mut last = structure.tree.joint_links[first].1;
            let mut next = structure.joints_after(last);
            let is_simple = |joint: usize| structure.view.joints[joint].num_dofs() == 1;
            while let [joint] = next[..] {
                // A joint of several DOFs is a chain of its own.
                if !is_simple(first) || !is_simple(joint) {
                    break;
                }
                joints.push(joint);
                last = structure.tree.joint_links[joint].1;
                next = structure.joints_after(last);
            }
            let place = all.len();
            match parent {
                Some(parent) => all[parent].children.push(place),
                None => roots.push(place),
            }
            open.extend(starts(last, Some(place)));
            let (base, child) = structure.tree.joint_links[first];
            let origin = poses[child].translation.vector;
            let distance = |link: usize| (poses[link].translation.vector - origin).norm();
            let links = structure.links_after(child).into_iter();
            all.push(Chain {
                joints,
                base,
                last,
                children: Vec::new(),
                reach: links.map(distance).fold(0.0, f64::max),
            });
        }
        Chains { all, roots }
    }

    /// The joints of a chain and of all that begin at its end, in joint order.
    pub fn joints_from(&self, chain: usize) -> Vec<usize> {
        let mut joints = Vec::new();
        let mut open = vec![chain];
        while let Some(chain) = open.pop() {
            joints.extend(&self.all[chain].joints);
            open.extend(&self.all[chain].children);
        }
        joints.sort_unstable();
        joints
    }
}
