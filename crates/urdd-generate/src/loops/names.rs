//! What the names that a source says of loops stand for: links, joints and DOFs by name, each looked up at once.

use std::cell::Cell;
use std::collections::HashMap;

use super::Made;
use urdd_format::index::LinkIdx;
use urdd_format::nearest::nearest;
use urdd_format::short::Short;

/// What names stand for.
pub(super) struct Names<'a> {
    /// Links, and for the name of a joint that no link has, the joint's child: Extended URDF means that.
    links: HashMap<&'a str, LinkIdx>,
    /// Joints, by their place in the chain.
    joints: HashMap<&'a str, usize>,
    /// DOFs: of the DOF of this name, or all of the joint.
    dofs: HashMap<&'a str, Vec<usize>>,
    /// How many names that nothing has were compared with all others.
    compared: Cell<usize>,
}

/// How many are: each takes as long as there are names.
const MOST_COMPARED: usize = 20;

impl Made<'_> {
    /// What the names of the robot stand for.
    pub(super) fn names(&self) -> Names<'_> {
        let mut names = Names {
            links: HashMap::new(),
            joints: HashMap::new(),
            dofs: HashMap::new(),
            compared: Cell::new(0),
        };
        let links = self.chain.links_in_chain.iter().map(|link| link.name.as_str());
        names.links.extend(links.zip((0..).map(LinkIdx)));
        for (place, joint) in self.chain.joints_in_chain.iter().enumerate() {
            names.joints.entry(&joint.joint_name).or_insert(place);
            names.links.entry(&joint.joint_name).or_insert(joint.child_link_idx);
        }
        for (idx, of) in self.dof.dofs.iter().enumerate() {
            names.dofs.entry(&of.joint_name).or_default().push(idx);
        }
        for (idx, of) in self.dof.dofs.iter().enumerate().rev() {
            names.dofs.insert(&of.name, vec![idx]);
        }
        names
    }
}

impl Names<'_> {
    pub(super) fn link(&self, name: &str) -> Option<LinkIdx> {
        self.links.get(name).copied()
    }

    /// The place of a joint in the chain.
    pub(super) fn joint(&self, name: &str) -> Option<usize> {
        self.joints.get(name).copied()
    }

    pub(super) fn dofs(&self, name: &str) -> &[usize] {
        self.dofs.get(name).map_or(&[], Vec::as_slice)
    }

    /// That nothing has a name; of the first such names with the nearest one that something has.
    pub(super) fn unknown<'n>(
        &self,
        what: &str,
        name: &str,
        all: impl Iterator<Item = &'n str>,
    ) -> String {
        let compared = self.compared.replace(self.compared.get() + 1);
        let near = if compared < MOST_COMPARED { nearest(all, name) } else { None };
        let near =
            near.map_or_else(String::new, |near| format!("; did you mean `{}`?", Short::of(&near)));
        format!("there is no {what} `{}`{near}", Short::of(name))
    }
}
