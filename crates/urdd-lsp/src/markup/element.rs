//! Elements.

use std::ops::Range;

/// An attribute.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Attribute {
    /// The bytes of its name.
    pub name: Range<usize>,
    /// The bytes of its value, without quotes; empty and behind the name if there is none.
    pub value: Range<usize>,
}

/// An element.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Element {
    /// The bytes of its name; empty after a lone `<`.
    pub name: Range<usize>,
    /// From `<` to the end of the start tag.
    pub tag: Range<usize>,
    /// The end of the element, with its end tag.
    pub end: usize,
    pub attributes: Vec<Attribute>,
    /// Index of the element that contains it.
    pub parent: Option<usize>,
    /// Whether the start tag has its `>`.
    pub is_finished: bool,
}
