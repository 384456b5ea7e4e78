//! What a URDF says in places where URDF defines nothing: attributes of its elements, and elements inside shapes, limits
//! and the like. Elements directly in `<robot>`, `<link>` and `<joint>` are not among them: `urdf_module` has those.

use std::collections::HashMap;

use roxmltree::Node;

use crate::document::Xml;
use crate::element::{children, name, of};

/// What a part belongs to, by name.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Owner {
    /// The robot.
    Robot,
    /// A link.
    Link(String),
    /// A joint.
    Joint(String),
}

/// An attribute or an element that URDF does not define.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OtherPart {
    /// The elements between it and its owner, such as `limit` or `collision[1]/geometry`; empty for an attribute of the owner.
    pub path: String,
    /// The name of the attribute or element, with its prefix.
    pub name: String,
    /// The value of the attribute, or the element as it is written.
    pub value: String,
    /// Whether it is an attribute.
    pub is_attribute: bool,
}

/// What a URDF says where URDF defines nothing, by what it belongs to, in document order.
pub type OtherParts = HashMap<Owner, Vec<OtherPart>>;

/// Levels of elements below an owner that are looked into, twice as many as URDF has: each part has a path.
const DEEPEST: usize = 6;

/// The parts of a robot. Nothing of a text that is not well-formed.
pub fn other_parts(urdf: &Xml<'_>) -> OtherParts {
    let mut parts = OtherParts::new();
    let Ok(document) = urdf.document() else { return parts };
    let root = document.root_element();
    let owned = children(root).filter_map(|(tag, element)| Some((owner(tag, element)?, element)));
    for (owner, element) in std::iter::once((Owner::Robot, root)).chain(owned) {
        let of_owner = parts_below(element);
        if !of_owner.is_empty() {
            parts.entry(owner).or_default().extend(of_owner);
        }
    }
    parts
}

/// The owner that an element directly in `<robot>` is.
fn owner(tag: &str, element: Node<'_, '_>) -> Option<Owner> {
    let name = || element.attribute("name").unwrap_or_default().to_owned();
    match tag {
        "link" => Some(Owner::Link(name())),
        "joint" => Some(Owner::Joint(name())),
        _ => None,
    }
}

/// The parts of the element of an owner.
fn parts_below(top: Node<'_, '_>) -> Vec<OtherPart> {
    let mut parts = Vec::new();
    let text = top.document().input_text();
    let is_robot = top == top.document().root_element();
    // Depth is bounded by the parser; a stack keeps it off the call stack.
    let mut open = vec![(top, String::new(), 0)];
    while let Some((element, path, depth)) = open.pop() {
        let mut add = |name: &str, value: &str, is_attribute: bool| {
            let (path, name, value) = (path.clone(), name.to_owned(), value.to_owned());
            parts.push(OtherPart { path, name, value, is_attribute });
        };
        let known = of(name(element)).map_or(&[][..], |known| known.attributes);
        for attribute in element.attributes() {
            let name = &text[attribute.range_qname()];
            if !known.contains(&name) {
                add(name, attribute.value(), true);
            }
        }
        let start = open.len();
        let mut counts: HashMap<&str, usize> = HashMap::new();
        for (tag, child) in children(element) {
            let is_top = depth == 0;
            if of(tag).is_none() || depth == DEEPEST {
                if !is_top {
                    add(tag, &text[child.range()], false);
                }
            } else if !(is_robot && is_top && owner(tag, child).is_some()) {
                let slash = if is_top { "" } else { "/" };
                let count = counts.entry(tag).or_default();
                let number = if *count == 0 { String::new() } else { format!("[{count}]") };
                *count += 1;
                open.push((child, format!("{path}{slash}{tag}{number}"), depth + 1));
            }
        }
        open[start..].reverse();
    }
    parts
}
