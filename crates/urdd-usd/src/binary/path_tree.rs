//! Paths as a tree, of which each node has its parent.

use super::super::value::Name;

/// A path.
#[derive(Debug, Clone)]
pub struct PathNode {
    /// The path that it is inside of.
    pub parent: Option<u32>,
    pub name: Name,
    pub is_property: bool,
    pub level: u32,
}

/// All paths, by their numbers.
#[derive(Debug, Default)]
pub struct Paths {
    pub nodes: Vec<Option<PathNode>>,
    /// Texts that were made.
    pub texts: Vec<Option<Name>>,
}

impl Paths {
    /// The path of a number.
    pub fn node(&self, index: u32) -> Option<&PathNode> {
        self.nodes.get(index as usize)?.as_ref()
    }
}
