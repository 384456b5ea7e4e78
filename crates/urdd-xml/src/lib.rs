//! Internal to urdd; no stability promise.
//!
//! Parses untrusted XML. This crate does not know the URDD format.
//!
//! Before parsing, this crate limits what a small file can use to exhaust time or memory: nesting depth, elements,
//! attributes, prefixes and entity declarations. `roxmltree` compares each attribute of an element with the others, and
//! copies an element's namespaces to each descendant that declares one. Its time and memory are quadratic or cubic.

mod count;
mod declaration;
pub mod element;
mod words;

pub use declaration::wrong_version;
use roxmltree::{Document, ParsingOptions, TextPos};

/// Maximum nesting depth. A URDF has 6 levels and a COLLADA scene some 20; that of a snake robot with 100 joints has
/// 110.
pub const MOST_LEVELS: usize = 256;

/// Maximum number of nodes of a document: elements, texts, comments. A robot with 2,000 links has some 100,000.
pub const MOST_NODES: usize = 4_000_000;

/// Maximum number of elements of a URDF: enough for some 20,000 links with two shapes each.
pub const MOST_ROBOT_ELEMENTS: usize = 500_000;

/// Maximum number of attributes of one element, including namespace declarations; real ones have up to 10.
pub const MOST_ATTRIBUTES: usize = 256;

/// Maximum number of namespace prefixes of a document; real ones have up to 10.
pub const MOST_PREFIXES: usize = 64;

/// The kind of document to parse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A URDF (SPEC 6.1.8): at most [`MOST_ROBOT_ELEMENTS`] elements. A `<!DOCTYPE robot>` is skipped; external files
    /// that it references are never fetched.
    Robot,
    /// Any other document, such as a COLLADA scene. A document type is an error.
    Other,
}

impl Kind {
    fn most_elements(self) -> usize {
        match self {
            Kind::Robot => MOST_ROBOT_ELEMENTS,
            Kind::Other => MOST_NODES,
        }
    }
}

/// Why a document was rejected.
#[derive(Debug)]
pub enum XmlError {
    /// Not well-formed XML.
    Parser(roxmltree::Error),
    /// It declares entities, which can expand a small file exponentially.
    Entities(TextPos),
    /// The version of the XML declaration is not 1.x.
    Version {
        /// The version.
        found: String,
        /// Its position.
        pos: TextPos,
    },
    /// The XML declaration names an encoding other than UTF-8.
    Encoding {
        /// The encoding.
        found: String,
        /// Its position.
        pos: TextPos,
    },
    /// A limit is exceeded.
    TooMany {
        /// The limited items.
        what: &'static str,
        /// The limit.
        limit: usize,
        /// The start of the element that exceeds the limit.
        pos: TextPos,
    },
}

impl XmlError {
    /// The position of the error.
    pub fn pos(&self) -> TextPos {
        match self {
            XmlError::Parser(error) => error.pos(),
            XmlError::Entities(pos)
            | XmlError::Version { pos, .. }
            | XmlError::Encoding { pos, .. }
            | XmlError::TooMany { pos, .. } => *pos,
        }
    }

    /// The error message for `text`, without the position: what is wrong and what to do.
    pub fn words(&self, text: &str) -> String {
        words::of(self, text)
    }
}

/// Parses a document.
///
/// # Errors
/// [`XmlError`] if the document is not well-formed, declares entities, or exceeds a limit. For [`Kind::Robot`], also if
/// the XML declaration names a wrong version or encoding.
pub fn parse(text: &str, kind: Kind) -> Result<Document<'_>, XmlError> {
    count::check(text, kind)?;
    if kind == Kind::Robot {
        declaration::check(text)?;
    }
    let options = ParsingOptions {
        allow_dtd: kind == Kind::Robot,
        nodes_limit: u32::try_from(MOST_NODES).unwrap_or(u32::MAX),
        ..ParsingOptions::default()
    };
    Document::parse_with_options(text, options).map_err(XmlError::Parser)
}

/// The line and column of a byte, counted as the parser does.
fn text_pos(text: &str, offset: usize) -> TextPos {
    let before = &text[..offset];
    let line = before.rsplit('\n').next().unwrap_or_default();
    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    TextPos::new(
        count(before.matches('\n').count() + 1),
        count(line.chars().count() + 1),
    )
}

#[cfg(test)]
mod tests;
