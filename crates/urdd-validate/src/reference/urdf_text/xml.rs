//! Elements of the XML tree by their names as written, and their numbers. A name with a prefix (`xacro:link`) is not a URDF name, whatever the
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

/// The numbers of an attribute: decimal, with or without fraction, exponent and sign (`+.01`, `1.`, `-5e-2`), separated
/// and surrounded by white space. `inf`, `nan` and numbers beyond binary64 are read as numbers that are not finite.
pub fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let mut numbers = [0.0; N];
    let mut words = text.split_ascii_whitespace();
    for number in &mut numbers {
        *number = words.next()?.parse().ok()?;
    }
    words.next().is_none().then_some(numbers)
}
