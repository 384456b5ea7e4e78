//! What a document may have.

/// Maximum nesting depth. A URDF has 6 levels and a COLLADA scene some 20; that of a snake robot with 100 joints has
/// 110.
pub const MAX_LEVELS: usize = 256;

/// Maximum number of nodes of a document: elements, texts, comments. A robot with 2,000 links has some 100,000.
pub const MAX_NODES: usize = 4_000_000;

/// Maximum number of elements of a URDF: enough for some 20,000 links with two shapes each.
pub const MAX_ROBOT_ELEMENTS: usize = 500_000;

/// Maximum number of attributes of one element, including namespace declarations; real ones have up to 10.
pub const MAX_ATTRIBUTES: usize = 256;

/// Maximum number of namespace prefixes of a document; real ones have up to 10.
pub const MAX_PREFIXES: usize = 64;

/// Maximum number of bytes of namespaces that are compared: the parser compares the attributes of an element that have a
/// prefix with one another. Real documents have up to a million.
pub(super) const MAX_COMPARED_BYTES: usize = 1 << 30;

/// The kind of document to parse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A URDF (SPEC 6.1.8): at most [`MAX_ROBOT_ELEMENTS`] elements. A `<!DOCTYPE robot>` is skipped; external files
    /// that it references are never fetched.
    Robot,
    /// Any other document, such as a COLLADA scene. A document type is an error.
    Other,
    /// A document as another program's parser has it: as [`Kind::Other`], but a document type is skipped.
    Lenient,
}

impl Kind {
    pub(super) fn most_elements(self) -> usize {
        match self {
            Kind::Robot => MAX_ROBOT_ELEMENTS,
            Kind::Other | Kind::Lenient => MAX_NODES,
        }
    }
}
