//! What a place of a URDF names: a link, a joint, a material, a mesh.

use std::ops::Range;

use crate::document::Snapshot;
use crate::markup::{Attribute, Markup, Place, unescaped};

/// What a place names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// What it is; links and joints are told apart where the text has a link of the name.
    pub to: Names,
    pub name: String,
    /// The bytes that name it.
    pub range: Range<usize>,
    pub element: usize,
}

/// What the names in an attribute are of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Names {
    Links,
    Joints,
    /// Links and joints.
    Both,
    Materials,
    Meshes,
}

/// What an attribute of an element names.
pub fn names(text: &str, markup: &Markup, element: usize, attribute: &str) -> Option<Names> {
    let parent = markup.parent_name(text, element).unwrap_or_default();
    match (parent, markup.name(text, element), attribute) {
        (_, "parent" | "child", "link") | (_, "link", "name") => Some(Names::Links),
        // URDF+.
        ("loop" | "coupling", "predecessor" | "successor", "link") => Some(Names::Links),
        (_, "mimic", "joint") | (_, "joint", "name") => Some(Names::Joints),
        (_, "gazebo", "reference") => Some(Names::Both),
        (_, "material", "name") => Some(Names::Materials),
        (_, "mesh", "filename") => Some(Names::Meshes),
        _ => None,
    }
}

/// What is named at an offset: in the value of an attribute, or by the tag of a link or joint.
pub fn reference(snapshot: &Snapshot, offset: usize) -> Option<Found> {
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    let names = |element, attribute: &Attribute| {
        names(text, markup, element, &text[attribute.name.clone()])
    };
    let (element, attribute, range) = match markup.place(text, offset) {
        Place::Content { .. } | Place::EndTag { .. } => return None,
        Place::Value { element, attribute } => {
            let attribute = markup.elements[element].attributes.get(attribute)?;
            (element, attribute, attribute.value.clone())
        }
        // Anywhere else in the start tag: its first attribute that names something.
        Place::TagName { element } | Place::AttributeName { element, .. } => {
            let tag = &markup.elements[element];
            let mut attributes = tag.attributes.iter();
            let first = attributes.find(|attribute| names(element, attribute).is_some())?;
            (element, first, tag.tag.clone())
        }
    };
    let name = unescaped(&text[attribute.value.clone()]).into_owned();
    let to = match names(element, attribute)? {
        Names::Both if snapshot.outline().link(&name).is_some() => Names::Links,
        Names::Both => Names::Joints,
        to => to,
    };
    Some(Found { to, name, range, element })
}
