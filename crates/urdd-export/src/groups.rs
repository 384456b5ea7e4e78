//! Joint groups, as the DOFs of a robot: those of a setup, and of an SRDF.

use std::collections::BTreeSet;

use crate::error::unknown;
use crate::setup::{contains_itself, within};
use crate::srdf::SrdfError;
use crate::{ExportError, Members, Setup, Structure};
use urdd_robot::Robot;
use urdd_srdf::{ReadError, Srdf};
use urdd_xml::Node;

/// A group of joints that a planner moves together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JointGroup {
    /// Its name.
    pub name: String,
    /// The DOFs of its joints, ascending: none of joints that are fixed or follow others.
    pub dofs: Vec<usize>,
}

impl Setup {
    /// The groups, in the order of the file.
    ///
    /// # Errors
    /// If the description of the robot is missing or unusable, or the setup is that of another robot.
    pub fn joint_groups(&self, robot: &Robot) -> Result<Vec<JointGroup>, ExportError> {
        let structure = Structure::new(robot)?;
        structure.check(&self.of)?;
        let groups = self.groups.iter().enumerate().map(|(place, group)| {
            let joints = joints_of(self, place, &structure);
            JointGroup::of(&group.value.name, joints, robot, &structure)
        });
        groups.collect()
    }
}

impl JointGroup {
    pub(super) fn of(
        name: &str,
        joints: impl IntoIterator<Item = usize>,
        robot: &Robot,
        structure: &Structure,
    ) -> Result<Self, ExportError> {
        let mut dofs = Vec::new();
        for joint in joints {
            if structure.moves(joint) {
                let (parent, child) = structure.tree.joint_links[joint];
                dofs.extend(robot.dofs_between(parent, child)?);
            }
        }
        dofs.sort_unstable();
        let name = name.to_owned();
        Ok(JointGroup { name, dofs })
    }
}

/// The joints of a group that move it, in joint order: none that are fixed or follow others.
pub(super) fn joints_of(setup: &Setup, group: usize, structure: &Structure) -> Vec<usize> {
    let members = |group: usize| &setup.groups[group].value.members;
    let inner = |group: usize| match members(group) {
        Members::Groups(others) => others.as_slice(),
        _ => &[],
    };
    let mut joints = Vec::new();
    for group in within(group, setup.groups.len(), inner).unwrap_or_default() {
        match members(group) {
            Members::Chain { base, tip } => joints.extend(structure.between(*base, *tip)),
            Members::Joints(own) => joints.extend(own),
            Members::Groups(_) => {}
        }
    }
    joints.retain(|joint| structure.moves(*joint));
    joints.sort_unstable();
    joints.dedup();
    joints
}

/// The groups of an SRDF, in the order of the file: their joints, the joints above their links, their chains, and the
/// groups in them.
///
/// # Errors
/// If the text is not an SRDF of the robot, or a group names what there is not, or contains itself.
pub fn joint_groups_of_srdf(robot: &Robot, text: &str) -> Result<Vec<JointGroup>, SrdfError> {
    let structure = Structure::new(robot)?;
    let srdf = Srdf::of(text, &structure.view.name)?;
    let tables: Vec<Node> = srdf.elements("group").collect();
    let name = |node: &Node| node.attribute("name").unwrap_or_default().to_owned();
    let names: Vec<String> = tables.iter().map(name).collect();
    let own = tables.iter().map(|table| members(&srdf, *table, &structure, &names));
    let own = own.collect::<Result<Vec<_>, ReadError>>()?;
    let groups = (0..own.len()).map(|place| {
        let inner = |group: usize| own[group].1.as_slice();
        let all = within(place, own.len(), inner)
            .ok_or_else(|| srdf.wrong(tables[place], contains_itself(&names[place])))?;
        let joints = all.iter().flat_map(|group| own[*group].0.iter().copied());
        let joints: BTreeSet<usize> = joints.collect();
        Ok(JointGroup::of(&names[place], joints, robot, &structure)?)
    });
    groups.collect()
}

/// The joints and the groups of a group.
fn members(
    srdf: &Srdf,
    table: Node,
    structure: &Structure,
    groups: &[String],
) -> Result<(Vec<usize>, Vec<usize>), ReadError> {
    let (mut joints, mut inner) = (Vec::new(), Vec::new());
    let view = &structure.view;
    let tree = &structure.tree;
    let link_names = || view.links.iter().map(|link| link.name.as_str());
    for node in table.children().filter(Node::is_element) {
        let link = |attribute| place(srdf, node, "link", attribute, link_names());
        match node.tag_name().name() {
            "joint" => {
                let names = view.joints.iter().map(|joint| joint.name.as_str());
                joints.push(place(srdf, node, "joint", "name", names)?);
            }
            "link" => joints.extend(tree.parent_joint[link("name")?]),
            "chain" => {
                let [base, tip] = [link("base_link")?, link("tip_link")?];
                if base != tip && structure.between(base, tip).is_empty() {
                    let reason = "the base of this chain is not above its tip";
                    return Err(srdf.wrong(node, reason));
                }
                joints.extend(structure.between(base, tip));
            }
            "group" => {
                let names = groups.iter().map(String::as_str);
                inner.push(place(srdf, node, "group", "name", names)?);
            }
            _ => {}
        }
    }
    Ok((joints, inner))
}

/// The place of what an attribute names.
fn place<'n>(
    srdf: &Srdf,
    node: Node,
    what: &'static str,
    attribute: &str,
    mut names: impl Iterator<Item = &'n str> + Clone,
) -> Result<usize, ReadError> {
    let name = node.attribute(attribute).unwrap_or_default();
    let all = names.clone();
    let found = names.position(|known| known == name);
    found.ok_or_else(|| srdf.wrong(node, unknown(what, name, all)))
}
