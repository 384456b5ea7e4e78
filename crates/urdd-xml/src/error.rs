//! Why a document is rejected, and where.

use roxmltree::TextPos;

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
    /// Not well-formed in a way that the parser accepts.
    NotWellFormed {
        /// What is wrong, and what to do.
        what: &'static str,
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
            | XmlError::NotWellFormed { pos, .. }
            | XmlError::TooMany { pos, .. } => *pos,
        }
    }
}

/// The line and column of a byte, counted as the parser does.
pub(super) fn text_pos(text: &str, offset: usize) -> TextPos {
    let before = &text[..offset];
    let line = before.rsplit('\n').next().unwrap_or_default();
    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    TextPos::new(count(before.matches('\n').count() + 1), count(line.chars().count() + 1))
}
