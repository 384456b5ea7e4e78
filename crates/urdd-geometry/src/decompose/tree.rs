//! The tree of cuts that the searches grow.

use super::part::Plane;

/// A node of the tree; the first of a list is the root. Leaf numbers are indices of the list of leaves.
#[derive(Clone, Copy, Debug)]
pub(super) enum Node {
    Leaf(usize),
    /// The child nodes below and above, as indices of the node list.
    Cut(Plane, [usize; 2]),
}

/// Makes the leaf at `node` a cut between two `leaves`, below and above; returns their nodes.
pub(super) fn divide(
    nodes: &mut Vec<Node>,
    node: usize,
    plane: Plane,
    leaves: [usize; 2],
) -> [usize; 2] {
    let sides = [nodes.len(), nodes.len() + 1];
    nodes[node] = Node::Cut(plane, sides);
    nodes.extend(leaves.map(Node::Leaf));
    sides
}
