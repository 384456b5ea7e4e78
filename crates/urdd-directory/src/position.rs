//! Positions in a text, and faults of the text of a JSON or YAML file, independent of its content.

use std::collections::BTreeMap;
use std::fmt;

use crate::json_scan;

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
/// For duplicate keys, the last one counts, as in the value that [`crate::json::read`] returns.
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

/// Number of faults of each kind that are kept; further ones are only counted.
pub const KEPT_PER_KIND: usize = 5;

/// The kinds of text fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TextFaultKind {
    /// The file is not JSON.
    Syntax,
    /// The JSON file is not UTF-8.
    NotUtf8,
    /// The JSON file begins with a byte order mark.
    ByteOrderMark,
    /// A JSON object has a duplicate member.
    DuplicateKey,
    /// `NaN`, `Infinity`, or a number too large for a 64-bit float.
    NonFiniteNumber,
    /// The JSON is nested deeper than the limit.
    TooDeep,
    /// The file is not YAML.
    YamlSyntax,
    /// The YAML file is not UTF-8.
    YamlNotUtf8,
    /// The YAML file begins with a byte order mark.
    YamlByteOrderMark,
    /// A node has a tag, such as `!Mesh`.
    YamlTag,
    /// An anchor (`&a`) or an alias (`*a`).
    YamlAnchorOrAlias,
    /// A merge key (`<<`).
    YamlMergeKey,
    /// A YAML mapping has a duplicate key.
    YamlDuplicateKey,
    /// A scalar that YAML 1.1 and YAML 1.2 read differently.
    YamlAmbiguousScalar,
    /// The YAML differs from the JSON.
    YamlDiffers,
    /// The YAML is nested deeper than the limit.
    YamlTooDeep,
    /// The file contains more than one document.
    YamlSeveralDocuments,
    /// A directive, such as `%YAML 1.1`.
    YamlDirective,
    /// A mapping key that is not a string.
    YamlNonStringKey,
}

/// One fault, with its position.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextFault {
    /// What is wrong.
    pub kind: TextFaultKind,
    /// RFC 6901 pointer to the value, if there is one.
    pub pointer: Option<String>,
    /// Position in the file, if there is one.
    pub position: Option<Position>,
    /// What is wrong and how to fix it.
    pub message: String,
    /// The expected content, if it is known.
    pub expected: Option<String>,
    /// The actual content.
    pub found: Option<String>,
}

impl TextFault {
    /// A fault without position and comparison.
    pub fn new(kind: TextFaultKind, message: impl Into<String>) -> Self {
        Self {
            kind,
            pointer: None,
            position: None,
            message: message.into(),
            expected: None,
            found: None,
        }
    }

    /// Sets the expected content.
    #[must_use]
    pub fn expecting(mut self, expected: impl Into<String>) -> Self {
        self.expected = Some(expected.into());
        self
    }

    /// Sets the actual content.
    #[must_use]
    pub fn finding(mut self, found: impl Into<String>) -> Self {
        self.found = Some(found.into());
        self
    }

    /// Sets the position of the fault.
    #[must_use]
    pub fn at(mut self, position: Position) -> Self {
        self.position = Some(position);
        self
    }

    /// Sets the pointer of the fault.
    #[must_use]
    pub fn of(mut self, pointer: String) -> Self {
        self.pointer = Some(pointer);
        self
    }
}

impl fmt::Display for TextFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(position) = self.position {
            write!(f, "{position}: ")?;
        }
        f.write_str(&self.message)
    }
}

/// The faults of one file: the first few of each kind, and the total of each kind.
///
/// A generated file may repeat a mistake a hundred thousand times; a few examples and a count say the same.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TextFaults {
    kept: Vec<TextFault>,
    totals: BTreeMap<TextFaultKind, usize>,
}

impl TextFaults {
    /// Counts a fault of `kind`. Calls `fault` only for the first few of each kind.
    pub fn add(&mut self, kind: TextFaultKind, fault: impl FnOnce() -> TextFault) {
        let total = self.totals.entry(kind).or_insert(0);
        *total += 1;
        if *total <= KEPT_PER_KIND {
            let fault = fault();
            debug_assert_eq!(fault.kind, kind);
            self.kept.push(fault);
        }
    }

    /// Counts an existing fault.
    pub fn push(&mut self, fault: TextFault) {
        self.add(fault.kind, || fault);
    }

    /// Whether there are no faults.
    pub fn is_empty(&self) -> bool {
        self.totals.is_empty()
    }

    /// Total number of faults of this kind, kept or not.
    pub fn total(&self, kind: TextFaultKind) -> usize {
        self.totals.get(&kind).copied().unwrap_or(0)
    }

    /// Every kind that occurred, with its total.
    pub fn totals(&self) -> impl Iterator<Item = (TextFaultKind, usize)> + '_ {
        self.totals.iter().map(|(&kind, &total)| (kind, total))
    }

    /// The kept faults, in the order in which they were found.
    pub fn iter(&self) -> std::slice::Iter<'_, TextFault> {
        self.kept.iter()
    }
}

impl<'a> IntoIterator for &'a TextFaults {
    type Item = &'a TextFault;
    type IntoIter = std::slice::Iter<'a, TextFault>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl fmt::Display for TextFaults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all: usize = self.totals.values().sum();
        match self.kept.first() {
            None => f.write_str("no fault"),
            Some(first) if all == 1 => write!(f, "{first}"),
            Some(first) => write!(f, "{first} (and {} more)", all - 1),
        }
    }
}

/// The text has no usable value; the faults say why.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{faults}")]
pub struct UnreadableText {
    /// The faults; never empty.
    pub faults: TextFaults,
}
