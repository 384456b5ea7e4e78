//! Elements of the XML tree by their names as written.

use urdd_xml::{Attribute, Node};

/// The name of an element as written. A name with a prefix (`xacro:link`) is not a URDF name, whatever the prefix
/// means; a default namespace changes no name.
pub(super) fn name<'a>(element: Node<'a, 'a>) -> &'a str {
    let text = element.document().input_text();
    let after = text.get(element.range().start + 1..).unwrap_or_default();
    let end = after
        .find(|c: char| c.is_ascii_whitespace() || c == '/' || c == '>')
        .unwrap_or(after.len());
    &after[..end]
}

/// The child elements of an element.
pub(super) fn elements<'a>(parent: Node<'a, 'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    parent.children().filter(Node::is_element)
}

/// The range of an element in the file.
pub(super) fn verbatim(element: Node<'_, '_>) -> String {
    element.document().input_text().get(element.range()).unwrap_or_default().to_owned()
}

/// An attribute by its name without a prefix. (`roxmltree` ignores prefixes.)
pub(super) fn attribute<'a>(element: Node<'a, 'a>, name: &str) -> Option<Attribute<'a, 'a>> {
    element
        .attributes()
        .find(|attribute| attribute.namespace().is_none() && attribute.name() == name)
}
