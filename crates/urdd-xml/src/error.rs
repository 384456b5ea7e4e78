//! Why a document is rejected, and where.

use roxmltree::TextPos;

/// Why a document was rejected.
#[derive(Debug)]
pub enum XmlError {
    /// Not well-formed XML.
    Parser(roxmltree::Error),
    /// It declares entities, which can expand a small file exponentially.
    Entities(TextPos),
    /// The parser would accept it: a wrong XML declaration, another fault that the parser does not see, or more items
    /// than a limit.
    Refused {
        /// What is wrong, and what to do.
        what: String,
        /// Its position.
        pos: TextPos,
    },
}

impl XmlError {
    /// The position of the error.
    pub fn pos(&self) -> TextPos {
        match self {
            XmlError::Parser(error) => error.pos(),
            XmlError::Entities(pos) | XmlError::Refused { pos, .. } => *pos,
        }
    }

    /// The byte of the error in the text that was parsed; its length for a place beyond it.
    pub fn offset(&self, text: &str) -> usize {
        offset(text, self.pos())
    }

    pub(super) fn refused(text: &str, offset: usize, what: impl Into<String>) -> Self {
        XmlError::Refused { what: what.into(), pos: text_pos(text, offset) }
    }
}

/// The line and column of a byte, counted as the parser does.
pub(super) fn text_pos(text: &str, offset: usize) -> TextPos {
    let before = &text[..offset];
    let line = before.rsplit('\n').next().unwrap_or_default();
    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    TextPos::new(count(before.matches('\n').count() + 1), count(line.chars().count() + 1))
}

/// The byte at a line and column that are counted as the parser does: lines end at `\n` alone.
pub(super) fn offset(text: &str, pos: TextPos) -> usize {
    let lines = text.split_inclusive('\n').take((pos.row as usize).saturating_sub(1));
    let start: usize = lines.map(str::len).sum();
    let before = text[start..].chars().take((pos.col as usize).saturating_sub(1));
    start + before.map(char::len_utf8).sum::<usize>()
}
