//! What a URDF says in places where URDF defines nothing: attributes of its elements, and elements inside shapes, limits
//! and the like. Elements directly in `<robot>`, `<link>` and `<joint>` are not among them: `urdf_module` has those.

use std::collections::HashMap;

use crate::element::{children, name};
use crate::vocabulary::of;

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

/// The parts of a robot. Nothing of a text that is not well-formed.
pub fn other_parts(urdf: &str) -> OtherParts {
    let mut parts = OtherParts::new();
    let Ok(document) = crate::parse(urdf, crate::Kind::Robot) else {
        return parts;
    };
    // Depth is bounded by the parser; a stack keeps it off the call stack.
    let mut open = vec![(document.root_element(), Owner::Robot, String::new())];
    while let Some((element, owner, path)) = open.pop() {
        let mut add = |name: &str, value: &str, is_attribute: bool| {
            let (path, name, value) = (path.clone(), name.to_owned(), value.to_owned());
            let part = OtherPart { path, name, value, is_attribute };
            parts.entry(owner.clone()).or_default().push(part);
        };
        let known = of(name(element)).map_or(&[][..], |known| known.attributes);
        for attribute in element.attributes() {
            let name = &document.input_text()[attribute.range_qname()];
            if !known.contains(&name) {
                add(name, attribute.value(), true);
            }
        }
        let start = open.len();
        let mut counts: HashMap<&str, usize> = HashMap::new();
        for (tag, child) in children(element) {
            let named = || child.attribute("name").unwrap_or_default().to_owned();
            let is_top = path.is_empty();
            if of(tag).is_none() {
                if !is_top {
                    add(tag, &document.input_text()[child.range()], false);
                }
                continue;
            }
            match (&owner, tag) {
                (Owner::Robot, "link") if is_top => {
                    open.push((child, Owner::Link(named()), String::new()));
                }
                (Owner::Robot, "joint") if is_top => {
                    open.push((child, Owner::Joint(named()), String::new()));
                }
                _ => {
                    let slash = if is_top { "" } else { "/" };
                    let count = counts.entry(tag).or_default();
                    let number = if *count == 0 { String::new() } else { format!("[{count}]") };
                    *count += 1;
                    open.push((child, owner.clone(), format!("{path}{slash}{tag}{number}")));
                }
            }
        }
        open[start..].reverse();
    }
    parts
}
