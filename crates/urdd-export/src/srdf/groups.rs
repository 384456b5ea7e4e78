//! Joint groups of an SRDF.

use std::collections::BTreeSet;

use urdd_xml::Node;

use super::import::SrdfError;
use crate::Structure;
use crate::error::unknown;
use crate::groups::JointGroup;
use crate::setup::{contains_itself, within};
use urdd_robot::Robot;
use urdd_srdf::{ReadError, Srdf};

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
    let reader = GroupReader { structure: &structure, names: &names, srdf: &srdf };
    let mut own = Vec::new();
    for table in &tables {
        own.push(reader.members(*table)?);
    }
    let all = own.iter().enumerate();
    all.map(|(place, _)| {
        let inner = |group: usize| own[group].1.as_slice();
        let groups = within(place, own.len(), inner)
            .ok_or_else(|| srdf.wrong(tables[place], contains_itself(&names[place])))?;
        let joints = groups.iter().flat_map(|group| own[*group].0.iter().copied());
        let joints: BTreeSet<usize> = joints.collect();
        Ok(JointGroup::of(&names[place], joints, robot, &structure)?)
    })
    .collect()
}

struct GroupReader<'a, 't> {
    structure: &'a Structure,
    names: &'a [String],
    srdf: &'a Srdf<'t>,
}

impl GroupReader<'_, '_> {
    /// The joints and the groups of a group.
    fn members(&self, table: Node) -> Result<(Vec<usize>, Vec<usize>), ReadError> {
        let (mut joints, mut groups) = (Vec::new(), Vec::new());
        let view = &self.structure.view;
        let tree = &self.structure.tree;
        let link_names = || view.links.iter().map(|link| link.name.as_str());
        for node in table.children().filter(Node::is_element) {
            let link = |attribute| self.place(node, "link", attribute, link_names());
            match node.tag_name().name() {
                "joint" => {
                    let names = view.joints.iter().map(|joint| joint.name.as_str());
                    joints.push(self.place(node, "joint", "name", names)?);
                }
                "link" => joints.extend(tree.parent_joint[link("name")?]),
                "chain" => {
                    let [base, tip] = [link("base_link")?, link("tip_link")?];
                    if base != tip && self.structure.between(base, tip).is_empty() {
                        let reason = "the base of this chain is not above its tip";
                        return Err(self.srdf.wrong(node, reason));
                    }
                    joints.extend(self.structure.between(base, tip));
                }
                "group" => {
                    let names = self.names.iter().map(String::as_str);
                    groups.push(self.place(node, "group", "name", names)?);
                }
                _ => {}
            }
        }
        Ok((joints, groups))
    }

    /// The place of what an attribute names.
    fn place<'n>(
        &self,
        node: Node,
        what: &'static str,
        attribute: &str,
        mut names: impl Iterator<Item = &'n str> + Clone,
    ) -> Result<usize, ReadError> {
        let name = node.attribute(attribute).unwrap_or_default();
        let all = names.clone();
        let found = names.position(|known| known == name);
        found.ok_or_else(|| self.srdf.wrong(node, unknown(what, name, all)))
    }
}
