//! Elements and numbers of a URDF's XML, which may be no robot.

use urdd_xml::Node;

use urdd_format::short;
use urdd_xml::element::children;

/// The joint types that have an axis.
pub const WITH_AXIS: [&str; 4] = ["revolute", "continuous", "prismatic", "planar"];
/// The joint types of one degree of freedom.
pub const ONE_DOF: [&str; 3] = ["revolute", "continuous", "prismatic"];

/// The child elements of a name.
pub fn named<'a>(node: Node<'a, 'a>, wanted: &str) -> impl Iterator<Item = Node<'a, 'a>> {
    children(node).filter(move |(name, _)| *name == wanted).map(|(_, child)| child)
}

/// The first child element of a name.
pub fn child<'a>(node: Node<'a, 'a>, wanted: &str) -> Option<Node<'a, 'a>> {
    named(node, wanted).next()
}

/// Finite numbers in an attribute, separated by white space; `None` if they are not `N` numbers (URD011 says so).
pub fn numbers<const N: usize>(node: Node, name: &str) -> Option<[f64; N]> {
    let words = node.attribute(name)?.split_ascii_whitespace();
    let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
    let numbers = <[f64; N]>::try_from(numbers?).ok()?;
    numbers.iter().all(|number| number.is_finite()).then_some(numbers)
}

/// A finite number in an attribute.
pub fn number(node: Node, name: &str) -> Option<f64> {
    numbers::<1>(node, name).map(|[number]| number)
}

/// The path of an element, without its place among those of the same name: findings at the same kind of element are one.
pub fn kind(node: Node) -> String {
    /// URDF is less deep.
    const LEVELS: usize = 8;
    let inside = node.ancestors().take_while(|node| node.parent_element().is_some());
    let names = inside.take(LEVELS).map(|one| short::name(one.tag_name().name()));
    let mut parts: Vec<_> = names.map(|name| format!("/{name}/*")).collect();
    parts.reverse();
    parts.concat()
}
