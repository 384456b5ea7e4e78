//! Elements and attributes that URDF does not define where they are.

use urdd_xml::Node;

use super::vocabulary::{CLOSED, KNOWN, Known, near, of};
use urdd_xml::element::children;

/// Something that URDF does not define.
#[derive(Debug, Clone)]
pub struct Unknown<'a> {
    /// The element, or that of the attribute.
    pub node: Node<'a, 'a>,
    /// Which of them it is.
    pub what: What<'a>,
    /// What it is a misspelling of.
    pub meant: Option<&'static str>,
    /// Whether no other name is as near.
    pub is_only: bool,
    /// The elements that something of this name belongs to.
    pub belongs: Vec<&'static str>,
}

/// An element or an attribute.
#[derive(Debug, Clone, Copy)]
pub enum What<'a> {
    /// The element itself.
    Element,
    /// Its attribute of this name.
    Attribute(&'a str),
}

impl<'a> Unknown<'a> {
    /// `near` is the name that is meant, and whether no other is as near; `has` finds the elements that it belongs to.
    fn new(
        node: Node<'a, 'a>,
        what: What<'a>,
        near: Option<(&'static str, bool)>,
        has: impl Fn(&&Known) -> bool,
    ) -> Self {
        let (meant, is_only) = near.unzip();
        let belongs = KNOWN.iter().filter(has).map(|known| known.name).collect();
        Unknown { node, what, meant, is_only: is_only == Some(true), belongs }
    }
}

/// Attributes that many elements have: one in a wrong place says nothing.
const EVERYWHERE: [&str; 5] = ["name", "type", "value", "link", "joint"];

/// All that is unknown in a robot.
pub fn unknown<'a>(root: Node<'a, 'a>) -> Vec<Unknown<'a>> {
    let mut found = Vec::new();
    let mut left: Vec<(Node<'a, 'a>, &'static Known)> =
        of("robot").map(|known| (root, known)).into_iter().collect();
    while let Some((node, known)) = left.pop() {
        let attributes = node.attributes().filter(|attribute| attribute.namespace().is_none());
        for attribute in attributes {
            let name = attribute.name();
            if !known.attributes.contains(&name) && !known.other_attributes.contains(&name) {
                let has = |known: &&Known| {
                    known.attributes.contains(&name) && !EVERYWHERE.contains(&name)
                };
                let near = near_attribute(node, name, known.attributes);
                found.push(Unknown::new(node, What::Attribute(name), near, has));
            }
        }
        for (name, child) in children(node).filter(|(name, _)| !name.contains(':')) {
            if known.children.contains(&name) {
                let inside = of(name).filter(|_| !CLOSED.contains(&name));
                left.extend(inside.map(|known| (child, known)));
            } else if !known.other_children.contains(&name) {
                let has = |known: &&Known| known.children.contains(&name);
                found.push(Unknown::new(child, What::Element, near(name, known.children), has));
            }
        }
    }
    found.sort_by_key(|unknown| unknown.node.range().start);
    found
}

/// The name that an attribute is a misspelling of: of several as near, one that the element does not have.
fn near_attribute(node: Node, name: &str, known: &[&'static str]) -> Option<(&'static str, bool)> {
    let best = near(name, known)?;
    if best.1 || !node.has_attribute(best.0) {
        return Some(best);
    }
    let mut missing = known.to_vec();
    missing.retain(|known| !node.has_attribute(*known));
    let other = near(name, &missing).map(|(other, _)| (other, false));
    other.or(Some(best))
}
