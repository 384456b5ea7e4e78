//! Elements and attributes, by the names that are written.

use roxmltree::{Attribute, Error, Node};

use crate::generate::fault::{Fault, PlacedFault};

pub(super) type Element<'a> = Node<'a, 'a>;

/// The name of an element, its prefix included: SPEC 6.1.8 knows elements by the name that is
/// written, so `xacro:link` is no link, whatever `xacro` stands for.
pub(super) fn name<'a>(element: Element<'a>) -> &'a str {
    let text = &element.document().input_text()[element.range()];
    let start = text.strip_prefix('<').unwrap_or(text);
    start
        .split(|c: char| c.is_ascii_whitespace() || c == '>' || c == '/')
        .next()
        .unwrap_or_default()
}

/// The elements directly in an element, with their names.
pub(super) fn children<'a>(parent: Element<'a>) -> impl Iterator<Item = (&'a str, Element<'a>)> {
    parent
        .children()
        .filter(Node::is_element)
        .map(|element| (name(element), element))
}

/// An element's own characters.
pub(super) fn verbatim(element: Element<'_>) -> String {
    element.document().input_text()[element.range()].to_owned()
}

/// An attribute without prefix.
pub(super) fn attribute<'a>(element: Element<'a>, name: &str) -> Option<Attribute<'a, 'a>> {
    element
        .attributes()
        .find(|attribute| attribute.name() == name && attribute.namespace().is_none())
}

/// What the parser refused, in words and with its place.
pub(super) fn fault(error: &Error, text: &str) -> PlacedFault {
    let words = match error {
        Error::UnexpectedDeclaration(_) => {
            "the declaration `<?xml …?>` may stand only at the very start of the file".to_owned()
        }
        Error::NodesLimitReached => format!("it has more than {} nodes", super::MAX_NODES),
        Error::NoRootNode | Error::UnclosedRootNode if text.trim().is_empty() => {
            "the file is empty".to_owned()
        }
        other => {
            // Its own words end with the place, which stands before them already.
            let words = other.to_string();
            match words.rsplit_once(" at ") {
                Some((words, place)) if place.contains(':') => words.to_owned(),
                _ => words,
            }
        }
    };
    let at = error.pos();
    PlacedFault {
        line: at.row,
        column: at.col,
        fault: Fault::NotXml(words),
    }
}
