//! What a place of a URDF names: a link, a joint, a material, a mesh.

use std::ops::Range;

use crate::document::Snapshot;
use crate::markup::{Markup, Place, unescaped};

/// What is named.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Reference {
    /// A link.
    Link(String),
    /// A joint.
    Joint(String),
    /// A material.
    Material(String),
    /// A mesh file.
    Mesh(String),
}

/// What a place names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// What is named.
    pub to: Reference,
    /// The bytes that name it.
    pub range: Range<usize>,
    /// The element.
    pub element: usize,
}

/// What the names in an attribute are of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Names {
    /// Links.
    Links,
    /// Joints.
    Joints,
    /// Links and joints.
    Both,
    /// Materials.
    Materials,
    /// Mesh files.
    Meshes,
}

/// What an attribute of an element names.
pub fn names(text: &str, markup: &Markup, element: usize, attribute: &str) -> Option<Names> {
    let parent = markup.parent_name(text, element).unwrap_or_default();
    match (parent, markup.name(text, element), attribute) {
        (_, "parent" | "child", "link") | (_, "link", "name") => Some(Names::Links),
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
    let outline = snapshot.outline();
    let place = markup.place(text, offset);
    let element = match place {
        Place::Content { .. } | Place::EndTag { .. } => return None,
        other => other.element()?,
    };
    let (name, attribute) = match place {
        Place::Value { attribute, .. } => {
            let attribute = markup.elements[element].attributes.get(attribute)?;
            (&text[attribute.name.clone()], attribute)
        }
        // Anywhere else in the start tag: its first attribute that names something.
        _ => {
            let mut attributes = markup.elements[element].attributes.iter();
            let first = attributes.find(|attribute| {
                names(text, markup, element, &text[attribute.name.clone()]).is_some()
            })?;
            (&text[first.name.clone()], first)
        }
    };
    let value = unescaped(&text[attribute.value.clone()]).into_owned();
    let to = match names(text, markup, element, name)? {
        Names::Links => Reference::Link(value),
        Names::Joints => Reference::Joint(value),
        Names::Both if outline.link(&value).is_none() => Reference::Joint(value),
        Names::Both => Reference::Link(value),
        Names::Materials => Reference::Material(value),
        Names::Meshes => Reference::Mesh(value),
    };
    let range = match place {
        Place::Value { .. } => attribute.value.clone(),
        _ => markup.elements[element].tag.clone(),
    };
    Some(Found { to, range, element })
}
