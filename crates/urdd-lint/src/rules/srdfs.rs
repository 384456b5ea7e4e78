use urdd_directory::position::{LineIndex, Position};
use urdd_srdf::vocabulary::{ELEMENTS, Known, ROBOT, Says, known, parts};
use urdd_xml::Document;

use super::prelude::*;
use crate::vocabulary::{Names, near};

declare_lint! {
    /// MoveIt does not read the robot's SRDF, or a part of it.
    ///
    /// srdfdom 2.0, MoveIt's reader, says so in its log at most, and goes on without the part: links that should not be checked for
    /// collisions are, a group or a named pose is missing.
    ///
    /// - The file is not well-formed XML, or is not a `<robot>`: an error, because MoveIt and Pinocchio refuse it whole.
    /// - It is of a robot of another name. MoveIt reports an error, and reads it.
    /// - An element is misspelt, or where none of its name is read.
    /// - An attribute that the element needs is missing. Pinocchio refuses an SRDF with a pair of one link.
    /// - A group of this name is not there; the type of a virtual joint is unknown; a position is not a number.
    ///
    /// Before: `<disable_colisions link1="base" lnik2="arm"/>`. After: `<disable_collisions link1="base" link2="arm"/>`.
    ///
    /// LNT045 has names of links and joints, and says where SRDFs are looked for.
    LNT063 "srdf-not-read", Warning, Format, since "1.3.0" => srdf_not_read;

    /// The robot's SRDF names a link or joint that the URDF does not have.
    ///
    /// MoveIt says `Link 'X' is not known to URDF`, and goes on without the line: a pair of links is checked for collisions
    /// although it should not be, or a group has no joints.
    ///
    /// Correct the name in the SRDF. SRDFs are looked for beside the URDF, in folders called `srdf` and `config` there and up to its
    /// package, in the folders inside of these (`config/arm/arm.srdf`), and in those of packages called `…moveit_config` beside the
    /// robot's. Those whose files have the URDF's name are its own; else the only one of a robot of this name, or the only one there
    /// is, if most of its names are those of the URDF. An SRDF in a folder that is of no robot there is named below the report.
    LNT045 "srdf-unknown-name", Warning, Format, since "1.1.0" => srdf_unknown_name
}

fn srdf_not_read(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for srdf in srdf::of_robot(urdf) {
        let of_file = |message: String, at| {
            let finding = Finding::in_file(&srdf.file.shown, message).position(Some(at));
            Finding { severity: Some(Severity::Error), ..finding }
        };
        let document = match srdf.document() {
            Ok(document) => document,
            Err(error) => {
                let (at, why) = (error.pos(), error.words(&srdf.file.text));
                let message = format!("the SRDF is not well-formed XML: {why}");
                of_file(message, Position { line: at.row, column: at.col }).report(findings);
                continue;
            }
        };
        let root = document.root_element();
        let mut reader = SrdfReader::new(&srdf.file.shown, document, findings);
        if root.tag_name().name() != ROBOT {
            let message = "MoveIt refuses the SRDF: its outermost element is not `<robot>`";
            let at = reader.lines.position(root.range().start);
            of_file(message.to_owned(), at).report(reader.findings);
            continue;
        }
        let (found, name) = (root.attribute("name"), urdf.root.attribute("name"));
        if found.map(str::trim) != name {
            let message = format!(
                "the SRDF is of robot `{}`, the URDF of `{}`, and MoveIt reports an error; write the URDF's name",
                found.unwrap_or_default(),
                name.unwrap_or_default()
            );
            reader.say(root, "name", message);
        }
        let allowed = ELEMENTS.iter().filter(|known| known.inside == ROBOT).map(|known| known.name);
        reader.inside(root, ROBOT, &allowed.collect::<Vec<_>>());
    }
    Some(())
}

/// Reads an SRDF as MoveIt does.
struct SrdfReader<'d, 'f> {
    file: &'d str,
    lines: LineIndex<'d>,
    groups: Names<'d>,
    findings: &'f mut Findings,
}

impl<'d, 'f> SrdfReader<'d, 'f> {
    fn new(file: &'d str, document: &'d Document<'d>, findings: &'f mut Findings) -> Self {
        let groups = named(document.root_element(), "group");
        let groups = groups.filter_map(|group| group.attribute("name"));
        SrdfReader {
            file,
            lines: LineIndex::new(document.input_text()),
            groups: Names::new(groups.map(str::trim)),
            findings,
        }
    }

    fn say(&mut self, node: Node<'d, 'd>, attribute: &str, message: impl Into<String>) {
        let one = node.attribute_node(attribute);
        let offset = one.map_or(node.range().start, |one| one.range().start);
        let at = Some(self.lines.position(offset));
        Finding::in_file(self.file, message).position(at).report(self.findings);
    }

    /// What is in an element that MoveIt reads.
    fn inside(&mut self, node: Node<'d, 'd>, of: &str, allowed: &[&str]) {
        for (name, child) in children(node) {
            if let Some(known) = known(name, of) {
                self.element(child, known);
                self.inside(child, name, known.holds);
            } else if known(name, ROBOT).is_some() {
                let message = format!(
                    "MoveIt ignores `<{name}>` in `<{of}>`; put it directly into `<robot>`"
                );
                self.say(child, "", message);
            } else if let Some((meant, _)) = near(name, allowed) {
                self.say(child, "", format!("MoveIt ignores `<{name}>`; write `<{meant}>`"));
            }
        }
    }

    fn element(&mut self, node: Node<'d, 'd>, known: &Known) {
        let (name, of) = (known.name, known.inside);
        let needed: Vec<&str> = known.needed.iter().map(|(attribute, _)| *attribute).collect();
        for attribute in &needed {
            if node.attribute(*attribute).is_none_or(|value| value.trim().is_empty()) {
                let there: Vec<&str> = node.attributes().map(|one| one.name()).collect();
                let other = there.into_iter().filter(|one| !needed.contains(one));
                let other = other
                    .filter(|one| near(one, &needed).is_some_and(|(near, _)| near == *attribute));
                let other = other.map(|one| format!(", but `{one}`")).next().unwrap_or_default();
                let message = format!(
                    "`<{name}>` has no `{attribute}`{other}, and MoveIt leaves it out; write `{attribute}`"
                );
                self.say(node, "", message);
            }
        }
        let groups = known.needed.iter().filter(|(_, says)| *says == Says::Group);
        // The only one that names something and is not needed.
        let parent = (name == "end_effector").then_some("parent_group");
        for attribute in groups.map(|(attribute, _)| *attribute).chain(parent) {
            let group = node.attribute(attribute).unwrap_or_default().trim();
            if !group.is_empty() && !self.groups.has(group) {
                let lost = if of == "group" { "the group around it" } else { "this element" };
                let hint = self.groups.hint(group);
                let message = format!(
                    "no group is called `{group}`{hint}, and MoveIt leaves out {lost}; write the name of a group"
                );
                self.say(node, attribute, message);
            }
        }
        let value = |attribute: &str| node.attribute(attribute).map(str::trim).unwrap_or_default();
        if of == "group_state"
            && value("value").split_whitespace().any(|one| one.parse::<f64>().is_err())
        {
            self.say(node, "value", "the position is not a number; write one, rad or m");
        }
        let types = ["fixed", "floating", "planar", ""];
        if name == "virtual_joint" && !types.contains(&value("type").to_lowercase().as_str()) {
            let message = "MoveIt takes a joint of this type for a fixed one; write `fixed`, `floating` or `planar`";
            self.say(node, "type", message);
        }
    }
}

fn srdf_unknown_name(urdf: &Subject, findings: &mut Findings) -> Option<()> {
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
