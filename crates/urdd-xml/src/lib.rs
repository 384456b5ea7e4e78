//! Parses XML from anybody. Knows no URDD.
//!
//! What a small file can make large is counted before any parser sees it: levels, elements,
//! attributes, prefixes, and declarations of entities. `roxmltree` compares each attribute of an
//! element with the others, and copies the namespaces of an element to those below it that declare
//! one: time and memory with the square, or the cube.

mod count;
mod declaration;
pub mod element;
mod words;

pub use declaration::wrong_version;
use roxmltree::{Document, ParsingOptions, TextPos};

/// Most levels of elements inside one another; a URDF has 6, a COLLADA scene some 20, and of a
/// snake robot of 100 joints 110.
pub const MOST_LEVELS: usize = 256;

/// Most nodes of a document: elements, texts, comments. A robot of 2,000 links has some 100,000.
pub const MOST_NODES: usize = 4_000_000;

/// Most elements of a URDF: some 20,000 links with two shapes each.
pub const MOST_ROBOT_ELEMENTS: usize = 500_000;

/// Most attributes of one element, declarations of namespaces among them; real ones have up to 10.
pub const MOST_ATTRIBUTES: usize = 256;

/// Most prefixes that a document declares; real ones have up to 10.
pub const MOST_PREFIXES: usize = 64;

/// What a document is read as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A URDF (SPEC 6.1.8): at most [`MOST_ROBOT_ELEMENTS`] elements; a `<!DOCTYPE robot>` is
    /// passed over, and what it names outside the file is never fetched.
    Robot,
    /// Anything else, a COLLADA scene say: without a document type.
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

/// Why a text is not parsed.
#[derive(Debug)]
pub enum XmlError {
    /// It is not well-formed.
    Parser(roxmltree::Error),
    /// It declares entities of its own: that is how small files grow large.
    Entities(TextPos),
    /// Its XML declaration names a version that is not 1.0, 1.1 and so on.
    Version {
        /// The version.
        found: String,
        /// Where it stands.
        pos: TextPos,
    },
    /// Its XML declaration names another encoding than UTF-8.
    Encoding {
        /// The encoding.
        found: String,
        /// Where it stands.
        pos: TextPos,
    },
    /// It has more of something than any document needs.
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// How many are allowed.
        limit: usize,
        /// Where the element begins that has it.
        pos: TextPos,
    },
}

impl XmlError {
    /// Where it is.
    pub fn pos(&self) -> TextPos {
        match self {
            XmlError::Parser(error) => error.pos(),
            XmlError::Entities(pos)
            | XmlError::Version { pos, .. }
            | XmlError::Encoding { pos, .. }
            | XmlError::TooMany { pos, .. } => *pos,
        }
    }

    /// What is wrong with `text`, without the place, and what to do.
    pub fn words(&self, text: &str) -> String {
        words::of(self, text)
    }
}

/// Parses a document.
///
/// # Errors
/// Where it is not well-formed, declares entities, or has too much of something.
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

/// The line and column of a byte, as the parser counts them.
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
