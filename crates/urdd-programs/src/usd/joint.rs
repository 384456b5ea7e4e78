//! A joint, and how elements are chosen.

use crate::tree::Node;

/// What it has of a joint.
pub(super) struct Joint<'t> {
    pub node: Node<'t>,
    pub name: &'t str,
    pub kind: &'t str,
    pub parent: &'t str,
    pub child: &'t str,
}

/// The last element of a name, which is the one that counts.
pub(super) fn last<'t>(node: Node<'t>, name: &str) -> Option<Node<'t>> {
    node.named(name).last()
}
