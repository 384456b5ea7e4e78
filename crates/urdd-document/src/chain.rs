//! Version-independent view of `chain_module`.

use urdd_format::chain::ChainModule;
use urdd_format::index::{JointIdx, LinkIdx};
use urdd_format::registry::ModuleDocument;

/// The kinematic tree of the module.
#[derive(Debug, Clone)]
pub struct Chain<'a> {
    /// Its links.
    pub links: Vec<ChainLink<'a>>,
    /// Its joints.
    pub joints: Vec<ChainJoint<'a>>,
    /// Links grouped by depth.
    pub hierarchy: &'a [Vec<LinkIdx>],
    /// The root link.
    pub root: LinkIdx,
    /// The module, if it is of version 1, which has more fields.
    pub v1: Option<&'a ChainModule>,
}

/// An element of `links_in_chain`, with its keys.
#[derive(Debug, Clone, Copy)]
#[expect(missing_docs, reason = "the format's type says it")]
pub struct ChainLink<'a> {
    pub name: &'a str,
    pub link_idx: LinkIdx,
    pub parent_joint_idx: Option<JointIdx>,
    pub parent_link_idx: Option<LinkIdx>,
    pub children_joint_idxs: &'a [JointIdx],
    pub children_link_idxs: &'a [LinkIdx],
}

/// An element of `joints_in_chain`, with its keys.
#[derive(Debug, Clone, Copy)]
#[expect(missing_docs, reason = "the format's type says it")]
pub struct ChainJoint<'a> {
    pub joint_name: &'a str,
    pub joint_idx: JointIdx,
    pub parent_link_name: &'a str,
    pub parent_link_idx: LinkIdx,
    pub child_link_name: &'a str,
    pub child_link_idx: LinkIdx,
}

macro_rules! view_of {
    ($module:expr, $v1:expr) => {
        Chain {
            links: $module
                .links_in_chain
                .iter()
                .map(|link| ChainLink {
                    name: &link.name,
                    link_idx: link.link_idx,
                    parent_joint_idx: link.parent_joint_idx,
                    parent_link_idx: link.parent_link_idx,
                    children_joint_idxs: &link.children_joint_idxs,
                    children_link_idxs: &link.children_link_idxs,
                })
                .collect(),
            joints: $module
                .joints_in_chain
                .iter()
                .map(|joint| ChainJoint {
                    joint_name: &joint.joint_name,
                    joint_idx: joint.joint_idx,
                    parent_link_name: &joint.parent_link_name,
                    parent_link_idx: joint.parent_link_idx,
                    child_link_name: &joint.child_link_name,
                    child_link_idx: joint.child_link_idx,
                })
                .collect(),
            hierarchy: &$module.kinematic_hierarchy,
            root: $module.root_idx,
            v1: $v1,
        }
    };
}

/// The view of a `chain_module`.
pub fn view(document: &ModuleDocument) -> Option<Chain<'_>> {
    match document {
        ModuleDocument::Chain(module) => Some(view_of!(module, Some(module))),
        ModuleDocument::LegacyChain(module) => Some(view_of!(module, None)),
        _ => None,
    }
}
