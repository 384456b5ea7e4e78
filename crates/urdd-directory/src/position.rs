//! Positions in a text as 1-based line and column.

use std::fmt;

use super::json_scan;

/// A position in a text: 1-based line and column. Columns count Unicode scalar values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Position {
    /// The line, from 1.
    pub line: u32,
    /// The column, from 1.
    pub column: u32,
}

impl Position {
    /// A position from 1-based counts of any size.
    pub(crate) fn of(line: usize, column: usize) -> Self {
        let [line, column] = [line, column].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
        Position { line, column }
    }
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.line, self.column)
    }
}

/// Start offsets of a text's lines, for fast lookup of many positions.
#[derive(Debug, Clone)]
pub struct LineIndex<'a> {
    text: &'a str,
    starts: Vec<usize>,
    /// Number of scalar values before each block of the text: a whole file may be one line.
    before_block: Vec<usize>,
}

/// Size of a block, bytes.
const BLOCK: usize = 1024;

impl<'a> LineIndex<'a> {
    /// Finds the lines of `text`. A line ends with `\n`, `\r\n`, or a lone `\r`.
    pub fn new(text: &'a str) -> Self {
        let bytes = text.as_bytes();
        let mut starts = vec![0];
        for (at, &byte) in bytes.iter().enumerate() {
            if byte == b'\n' || (byte == b'\r' && bytes.get(at + 1) != Some(&b'\n')) {
                starts.push(at + 1);
            }
        }
        let mut before_block = vec![0];
        let mut before = 0;
        for block in bytes.chunks(BLOCK) {
            before += scalars(block);
            before_block.push(before);
        }
        Self { text, starts, before_block }
    }

    /// The position of a byte offset. Offsets beyond the text give its end.
    pub fn position(&self, offset: usize) -> Position {
        let offset = offset.min(self.text.len());
        let line = self.starts.partition_point(|&start| start <= offset);
        let start = self.starts[line - 1];
        let before = self.scalars_before(offset) - self.scalars_before(start);
        Position::of(line, before + 1)
    }

    /// Number of scalar values that begin before a byte offset.
    fn scalars_before(&self, offset: usize) -> usize {
        let block = offset / BLOCK;
        self.before_block[block] + scalars(&self.text.as_bytes()[block * BLOCK..offset])
    }

    /// The byte offset of a position.
    pub fn offset(&self, at: Position) -> Option<usize> {
        let before = self.scalars_before(self.line_start(at.line as usize)?);
        let wanted = before + (at.column as usize).checked_sub(1)?;
        let block = self.before_block.partition_point(|before| *before <= wanted).checked_sub(1)?;
        let from = (block * BLOCK).min(self.text.len());
        let bytes = self.text.as_bytes()[from..].iter().enumerate();
        let starts = bytes.filter(|(_, byte)| begins_scalar(**byte)).map(|(at, _)| from + at);
        starts.chain([self.text.len()]).nth(wanted - self.before_block[block])
    }

    /// Byte offset of the start of a 1-based line.
    pub fn line_start(&self, line: usize) -> Option<usize> {
        self.starts.get(line.checked_sub(1)?).copied()
    }
}

/// The position of one byte offset in `text`.
pub fn position(text: &str, offset: usize) -> Position {
    LineIndex::new(text).position(offset)
}

/// The position of the value at an RFC 6901 pointer, in text that is valid JSON.
///
/// For duplicate keys, the last one counts, as in the value that [`super::json::read`] returns.
pub fn locate(text: &str, pointer: &str) -> Option<Position> {
    locate_all(text, &[pointer]).pop()?
}

/// Like [`locate`], for many pointers in one pass.
pub fn locate_all(text: &str, pointers: &[&str]) -> Vec<Option<Position>> {
    let index = LineIndex::new(text);
    let offsets = json_scan::find_values(text, pointers).into_iter();
    offsets.map(|offset| offset.map(|offset| index.position(offset))).collect()
}

/// Counts scalar values: every byte of UTF-8 except continuation bytes.
fn scalars(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&byte| begins_scalar(byte)).count()
}

fn begins_scalar(byte: u8) -> bool {
    byte & 0xC0 != 0x80
}

/// Byte offsets of ascending character offsets.
pub(crate) struct Offsets<'t> {
    text: &'t str,
    character: usize,
    byte: usize,
    is_ascii: bool,
}

impl<'t> Offsets<'t> {
    /// Starts at the beginning of a text.
    pub(crate) fn new(text: &'t str) -> Self {
        Offsets { text, character: 0, byte: 0, is_ascii: text.is_ascii() }
    }

    /// The byte offset of a character.
    pub(crate) fn bytes(&mut self, character: usize) -> usize {
        if self.is_ascii {
            return character.min(self.text.len());
        }
        if character < self.character {
            (self.character, self.byte) = (0, 0);
        }
        let rest = &self.text[self.byte..];
        let skipped = rest.char_indices().nth(character - self.character);
        self.byte += skipped.map_or(rest.len(), |(at, _)| at);
        self.character = character;
        self.byte
    }
}
