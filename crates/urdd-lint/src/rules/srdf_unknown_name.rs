use urdd_xml::Document;

use super::prelude::*;
use crate::vocabulary::Names;
use urdd_directory::position::LineIndex;
use urdd_srdf::vocabulary::parts;

declare_lint! {
    /// The robot's SRDF names a link or joint that the URDF does not have.
    ///
    /// MoveIt says `Link 'X' is not known to URDF`, and goes on without the line: a pair of links is checked for collisions
    /// although it should not be, or a group has no joints.
    ///
    /// Correct the name in the SRDF. SRDFs are looked for beside the URDF, in folders called `srdf` and `config` there and one level
    /// up, and in those of packages called `…moveit_config` beside the robot's. Those whose files have the URDF's name are its own;
    /// else the only one of a robot of this name, or the only one there is, if most of its names are those of the URDF.
    LNT045 "srdf-unknown-name", Warning, Format, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for srdf in srdf::of_robot(urdf) {
        // LNT063 says what is no XML.
        if let Ok(document) = srdf.document() {
            compare(urdf, &srdf.file.shown, document, findings);
        }
    }
    Some(())
}

/// Pinocchio's name of the joint that holds a free robot: its pose is a part of configurations in SRDFs.
const FREE_BASE: &str = "root_joint";

fn compare(urdf: &Subject, file: &str, document: &Document, findings: &mut Findings) {
    let root = document.root_element();
    let links = Names::new(urdf.names(&urdf.links));
    let joints = Names::new(urdf.names(&urdf.joints));
    let elements = || root.descendants().filter(Node::is_element);
    let virtual_joints = elements().filter(|node| node.tag_name().name() == "virtual_joint");
    let virtual_joints: BTreeSet<&str> =
        virtual_joints.filter_map(|node| Some(node.attribute("name")?.trim())).collect();
    let lines = LineIndex::new(document.input_text());
    let mut told = BTreeSet::new();
    for node in elements() {
        for (attribute, is_link, name) in parts(node) {
            let known = if is_link { &links } else { &joints };
            let is_free_base = !is_link && name == FREE_BASE;
            if known.has(name)
                || is_free_base
                || virtual_joints.contains(name)
                || !told.insert((is_link, name.to_owned()))
            {
                continue;
            }
            let kind = if is_link { "link" } else { "joint" };
            let hint = known.hint(name);
            let message = format!(
                "the URDF has no {kind} `{name}`{hint}; correct the name, or remove the line"
            );
            let offset =
                node.attribute_node(attribute).map_or(node.range().start, |one| one.range().start);
            Finding::in_file(file, message).position(Some(lines.position(offset))).report(findings);
        }
    }
}
