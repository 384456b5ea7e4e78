//! Rewrites the text of a part for the combined robot: prefixes names, renames meshes, removes what is dropped, and
//! fixes frozen joints.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use urdd_xml::{Document, Node};

use super::names::{self, LeftAlone, NamePlace, Named, escaped, mesh_edits};
use super::part::Loaded;
use super::trim::{Trim, frozen_origin};
use urdd_source::origin::has_quaternions;
use urdd_xml::element::{Edit, apply, attribute, children, name_at};
use urdd_xml::{Kind, parse};

/// The rewritten text of a part, and what to report about it.
#[derive(Debug)]
pub(super) struct Rewritten {
    pub inner: String,
    /// The XML namespaces that `<robot>` declares, by prefix; an empty prefix for the default namespace.
    pub namespaces: Vec<(String, String)>,
    /// New names of elements such as transmissions, which are not links, joints or materials.
    pub own: Vec<String>,
    /// Values that may name links or joints and were left unchanged.
    pub left_alone: BTreeSet<LeftAlone>,
    /// Elements that were removed with what they name.
    pub removed: Vec<String>,
}

pub(super) struct Rewrite<'a> {
    pub loaded: &'a Loaded,
    pub trim: &'a Trim,
    pub prefix: &'a str,
    /// Additional places of link and joint names.
    pub names: &'a BTreeSet<&'a str>,
    pub meshes: &'a BTreeMap<String, String>,
    /// Indices of top-level materials that an earlier part also has.
    pub repeated_materials: &'a BTreeSet<usize>,
    /// Whether `quat_xyzw` applies in the combined robot.
    pub quaternions: bool,
}

impl Rewrite<'_> {
    pub fn run(&self) -> Result<Rewritten, String> {
        let text = self.loaded.text.trim_start_matches('\u{feff}');
        let document = parse(text, Kind::Robot).map_err(|error| error.words(text))?;
        let found = names::find(&document, &self.loaded.robot, self.names);
        let mut edits = mesh_edits(&document, self.meshes);
        let dropped = self.structure(text, &document, &mut edits);
        let mut units = BTreeMap::new();
        let mut own = Vec::new();
        for place in &found.places {
            if dropped.contains(&place.top.start) {
                continue;
            }
            if self.goes(&document, place) {
                units.insert(place.unit.start, (place.unit.clone(), place.name.clone()));
                continue;
            }
            let name = format!("{}{}", self.prefix, place.name);
            edits.push(Edit { range: place.range.clone(), text: escaped(&name) });
            let is_top = place.unit == place.top;
            if place.named == Named::Own && is_top {
                own.push(name);
            }
        }
        let mut removed = Vec::new();
        for (range, name) in units.values() {
            edits.push(removal(text, range));
            let tag = name_at(text, range);
            removed.push(format!("`<{tag}>` with `{name}`"));
        }
        let namespaces = document.root_element().namespaces().map(|of| {
            let prefix = of.name().unwrap_or_default().to_owned();
            (prefix, of.uri().to_owned())
        });
        let namespaces = namespaces.filter(|(prefix, _)| prefix != "xml").collect();
        let edited = apply(text, edits);
        Ok(Rewritten {
            inner: inner(&edited)?,
            namespaces,
            own,
            left_alone: found.left_alone,
            removed,
        })
    }

    /// Whether the element around a name is removed with what it names. Links and joints themselves are removed by
    /// `structure`.
    fn goes(&self, document: &Document, place: &NamePlace) -> bool {
        let tag = name_at(document.input_text(), &place.top);
        if !place.unknown {
            return false;
        }
        let link = || self.loaded.links.get(&place.name).copied();
        let joint = || self.loaded.joints.get(&place.name).copied();
        let no_link = || link().is_none_or(|link| !self.trim.keeps_link(link));
        let no_joint = || joint().is_none_or(|joint| !self.trim.keeps_joint(joint));
        // Elements that drive a joint go with a frozen joint as well.
        let is_of_motion = matches!(tag, "transmission" | "ros2_control");
        let is_frozen = || joint().is_some_and(|joint| self.trim.frozen.contains_key(&joint));
        match place.named {
            Named::Link => no_link(),
            Named::Joint => no_joint() || (is_of_motion && is_frozen()),
            Named::Either => no_link() && no_joint(),
            Named::Own | Named::Material => false,
        }
    }

    /// Removes dropped links and joints and repeated materials, and fixes frozen joints. Returns the offsets of the
    /// dropped elements.
    fn structure(&self, text: &str, document: &Document, edits: &mut Vec<Edit>) -> BTreeSet<usize> {
        let mut dropped = BTreeSet::new();
        let (mut link_idx, mut joint_idx, mut material_idx) = (0, 0, 0);
        let root = document.root_element();
        for (tag, element) in children(root) {
            match tag {
                "link" => {
                    if !self.trim.keeps_link(link_idx) {
                        dropped.insert(element.range().start);
                        edits.push(removal(text, &element.range()));
                    }
                    link_idx += 1;
                }
                "joint" => {
                    if !self.trim.keeps_joint(joint_idx) {
                        dropped.insert(element.range().start);
                        edits.push(removal(text, &element.range()));
                    } else if let Some(position) = self.trim.frozen.get(&joint_idx) {
                        self.freeze(text, element, joint_idx, position, edits);
                    }
                    joint_idx += 1;
                }
                "material" => {
                    if self.repeated_materials.contains(&material_idx) {
                        edits.push(removal(text, &element.range()));
                    }
                    material_idx += 1;
                }
                _ => {}
            }
        }
        let own_version = self.loaded.robot.version.as_deref();
        if self.quaternions && !has_quaternions(own_version) {
            // Remove quaternions that had no effect before but would have one now.
            for origin in root.descendants().filter(Node::is_element) {
                let found =
                    attribute(origin, "quat_xyzw").filter(|_| origin.has_tag_name("origin"));
                if let Some(found) = found {
                    edits.push(removal(text, &found.range()));
                }
            }
        }
        dropped
    }

    fn freeze<'a>(
        &self,
        text: &str,
        element: Node<'a, 'a>,
        idx: usize,
        position: &[f64],
        edits: &mut Vec<Edit>,
    ) {
        let joint = &self.loaded.robot.joints[idx];
        if let Some(found) = attribute(element, "type") {
            edits.push(Edit { range: found.range_value(), text: "fixed".to_owned() });
        }
        let quaternions = has_quaternions(self.loaded.robot.version.as_deref());
        let origin = frozen_origin(joint, position, quaternions);
        let mut is_placed = false;
        for (tag, inner) in children(element) {
            match tag {
                "origin" if !is_placed => {
                    is_placed = true;
                    let (range, text) = (inner.range(), origin.clone());
                    edits.push(Edit { range, text });
                }
                "origin" | "axis" | "limit" | "dynamics" | "mimic" | "safety_controller"
                | "calibration" => edits.push(removal(text, &inner.range())),
                _ => {}
            }
        }
        if let (false, Some((_, first))) = (is_placed, children(element).next()) {
            let start = first.range().start;
            edits.push(Edit { range: start..start, text: origin });
        }
    }
}

/// Removes a range and the white space before it.
fn removal(text: &str, range: &Range<usize>) -> Edit {
    let before = text[..range.start].trim_end().len();
    Edit { range: before..range.end, text: String::new() }
}

fn inner(text: &str) -> Result<String, String> {
    let document = parse(text, Kind::Robot).map_err(|error| error.words(text))?;
    let root = document.root_element();
    let (Some(first), Some(last)) = (root.first_child(), root.last_child()) else {
        return Ok(String::new());
    };
    let inner = &text[first.range().start..last.range().end];
    Ok(inner.trim_end().trim_start_matches(['\n', '\r']).to_owned())
}
