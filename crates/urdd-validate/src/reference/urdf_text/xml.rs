//! Elements of the XML tree by their names as written. A name with a prefix (`xacro:link`) is not a URDF name, whatever the
//! prefix means; a default namespace changes no name.

use urdd_xml::Node;
pub(super) use urdd_xml::element::{attribute, name};

/// The child elements of an element.
pub(super) fn elements<'a>(parent: Node<'a, 'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    parent.children().filter(Node::is_element)
}

/// The range of an element in the file.
pub(super) fn verbatim(element: Node<'_, '_>) -> String {
    element.document().input_text().get(element.range()).unwrap_or_default().to_owned()
}
