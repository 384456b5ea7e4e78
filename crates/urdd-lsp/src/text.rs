//! A document's text, positions in it as editors count them, and texts that editors show.

use std::ops::Range;
use std::sync::OnceLock;

use lsp_types::{
    Hover, HoverContents, MarkupContent, MarkupKind, Position, PositionEncodingKind,
    TextDocumentContentChangeEvent,
};
use serde_json::Value;
use urdd_format::escape;

const BYTE_ORDER_MARK: char = '\u{feff}';

/// The unit that an editor counts columns in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Encoding {
    /// Bytes of UTF-8.
    Utf8,
    /// Units of UTF-16: the default of the protocol.
    #[default]
    Utf16,
    /// Scalar values.
    Utf32,
}

impl Encoding {
    /// The first of the editor's encodings that is known here: the editor lists the one that it prefers first.
    pub fn choose(offered: Option<&Value>) -> Self {
        let known = |kind: &Value| match kind.as_str()? {
            "utf-8" => Some(Encoding::Utf8),
            "utf-16" => Some(Encoding::Utf16),
            "utf-32" => Some(Encoding::Utf32),
            _ => None,
        };
        let mut offered = offered.and_then(Value::as_array).into_iter().flatten();
        offered.find_map(known).unwrap_or_default()
    }

    pub fn kind(self) -> PositionEncodingKind {
        match self {
            Encoding::Utf8 => PositionEncodingKind::UTF8,
            Encoding::Utf16 => PositionEncodingKind::UTF16,
            Encoding::Utf32 => PositionEncodingKind::UTF32,
        }
    }

    pub fn units(self, c: char) -> usize {
        match self {
            Encoding::Utf8 => c.len_utf8(),
            Encoding::Utf16 => c.len_utf16(),
            Encoding::Utf32 => 1,
        }
    }

    /// The units of the characters that begin in these bytes of UTF-8. Bytes of UTF-8 count all.
    fn units_in(self, bytes: &[u8]) -> usize {
        let begins = |byte: &&u8| **byte & 0xC0 != 0x80;
        // Characters of four bytes have two units of UTF-16.
        let is_pair = |byte: &&u8| **byte >= 0xF0;
        match self {
            Encoding::Utf8 => bytes.len(),
            Encoding::Utf16 => {
                bytes.iter().filter(begins).count() + bytes.iter().filter(is_pair).count()
            }
            Encoding::Utf32 => bytes.iter().filter(begins).count(),
        }
    }
}

/// Size of a block, bytes.
const BLOCK: usize = 1024;

/// A text with its lines. A line ends with `\n`, `\r\n`, or a lone `\r`.
#[derive(Debug, Clone)]
pub struct Text {
    text: String,
    starts: Vec<usize>,
    encoding: Encoding,
    /// Units before each block of the text, and scalar values: a whole file may be one line.
    units: OnceLock<Vec<usize>>,
    scalars: OnceLock<Vec<usize>>,
}

impl Text {
    pub fn new(text: String, encoding: Encoding) -> Self {
        let starts = std::iter::once(0).chain(line_starts(&text, 0)).collect();
        Text { starts, text, encoding, units: OnceLock::new(), scalars: OnceLock::new() }
    }

    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// The text without a byte order mark, which XML and rules do not count.
    pub fn content(&self) -> &str {
        &self.text[self.content_start()..]
    }

    /// Byte offset of [`Text::content`].
    pub fn content_start(&self) -> usize {
        if self.text.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len_utf8() } else { 0 }
    }

    /// The byte offset of an editor's position. A position beyond a line gives the line's end.
    pub fn offset(&self, position: Position) -> usize {
        let line = position.line as usize;
        let Some(&start) = self.starts.get(line) else {
            return self.text.len();
        };
        let end = start + self.line(line).len();
        self.behind(start..end, position.character as usize, self.encoding)
    }

    /// The editor's position of a byte offset. Offsets inside of a character, or beyond the text, give what is before.
    pub fn position(&self, offset: usize) -> Position {
        let mut offset = offset.min(self.text.len());
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        let line = self.starts.partition_point(|&start| start <= offset) - 1;
        // An offset in a line's end is shown at it.
        let start = self.starts[line];
        let offset = offset.min(start + self.line(line).len());
        Position {
            line: count(line),
            character: count(
                self.units_before(offset, self.encoding) - self.units_before(start, self.encoding),
            ),
        }
    }

    /// The units of the text's encoding, or the scalar values, before each block.
    fn before_blocks(&self, encoding: Encoding) -> &[usize] {
        let all = if encoding == self.encoding { &self.units } else { &self.scalars };
        all.get_or_init(|| {
            let blocks = self.text.as_bytes().chunks(BLOCK).scan(0, |before, block| {
                *before += encoding.units_in(block);
                Some(*before)
            });
            std::iter::once(0).chain(blocks).collect()
        })
    }

    /// The units before a byte offset.
    fn units_before(&self, offset: usize, encoding: Encoding) -> usize {
        let block = offset / BLOCK;
        let rest = &self.text.as_bytes()[block * BLOCK..offset];
        self.before_blocks(encoding)[block] + encoding.units_in(rest)
    }

    /// The byte offset behind a number of units of a part of the text, or its end. Half a character is not counted.
    fn behind(&self, part: Range<usize>, units: usize, encoding: Encoding) -> usize {
        let wanted = self.units_before(part.start, encoding).saturating_add(units);
        let block = self.before_blocks(encoding).partition_point(|&before| before <= wanted) - 1;
        // A character of UTF-8 that reaches into this block may be half counted: from where it begins.
        let mut from = (block * BLOCK).clamp(part.start, part.end);
        while !self.text.is_char_boundary(from) {
            from -= 1;
        }
        let mut passed = self.units_before(from, encoding);
        for (at, c) in self.text[from..part.end].char_indices() {
            passed += encoding.units(c);
            if passed > wanted {
                return from + at;
            }
        }
        part.end
    }

    pub fn range(&self, range: Range<usize>) -> lsp_types::Range {
        lsp_types::Range { start: self.position(range.start), end: self.position(range.end) }
    }

    /// The byte offset of a line and a column, from 1, in scalar values of [`Text::content`]: as reports have them.
    pub fn reported(&self, line: usize, column: usize) -> usize {
        let line = line.saturating_sub(1);
        let Some(&start) = self.starts.get(line) else {
            return self.text.len();
        };
        let start = start.max(if line == 0 { self.content_start() } else { 0 });
        let end = self.starts[line] + self.line(line).len();
        self.behind(start.min(end)..end, column.saturating_sub(1), Encoding::Utf32)
    }

    /// The offset of the end of the line of an offset, without what ends it.
    pub fn line_end(&self, offset: usize) -> usize {
        let line = self.starts.partition_point(|&start| start <= offset) - 1;
        self.starts[line] + self.line(line).len()
    }

    /// A line without what ends it.
    fn line(&self, line: usize) -> &str {
        let end = self.starts.get(line + 1).copied();
        let line = &self.text[self.starts[line]..end.unwrap_or(self.text.len())];
        let line = line.strip_suffix('\n').unwrap_or(line);
        line.strip_suffix('\r').unwrap_or(line)
    }

    pub fn apply(&mut self, change: TextDocumentContentChangeEvent) {
        let Some(range) = change.range else {
            *self = Text::new(change.text, self.encoding);
            return;
        };
        let start = self.offset(range.start);
        let end = self.offset(range.end).max(start);
        self.text.replace_range(start..end, &change.text);
        (self.units, self.scalars) = (OnceLock::new(), OnceLock::new());
        // Lines are found anew from the line before the change, whose end may be half of `\r\n`, to behind it.
        let first = self.starts.partition_point(|&start_of| start_of < start);
        let first = first.saturating_sub(1);
        let new_end = start + change.text.len();
        let kept = self.starts.partition_point(|&start_of| start_of <= end + 1);
        let later: Vec<usize> =
            self.starts[kept..].iter().map(|start_of| start_of - end + new_end).collect();
        let from = self.starts[first];
        // The line that contains the change's end, as far as its own end.
        let until = later.first().copied().unwrap_or(self.text.len());
        self.starts.truncate(first + 1);
        let found = line_starts(&self.text, from).take_while(|&start_of| start_of < until);
        self.starts.extend(found);
        if later.is_empty() && self.text.ends_with(['\n', '\r']) {
            self.starts.push(self.text.len());
        }
        self.starts.extend(later);
    }
}

/// The starts of the lines after the one that begins at `from`.
fn line_starts(text: &str, from: usize) -> impl Iterator<Item = usize> {
    let bytes = text.as_bytes();
    let ends = bytes[from..].iter().enumerate().filter(move |(at, byte)| {
        **byte == b'\n' || (**byte == b'\r' && bytes.get(from + at + 1) != Some(&b'\n'))
    });
    ends.map(move |(at, _)| from + at + 1)
}

fn count(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

pub fn markdown(value: String, range: Option<lsp_types::Range>) -> Hover {
    Hover {
        contents: HoverContents::Markup(MarkupContent { kind: MarkupKind::Markdown, value }),
        range,
    }
}

/// A sentence that may quote a file: nothing in it begins anything of Markdown.
pub fn sentence(text: &str) -> String {
    let mut shown = String::new();
    for c in escape::line(text).chars() {
        if "\\`*_[]<>&|~#".contains(c) {
            shown.push('\\');
        }
        shown.push(c);
    }
    shown
}

/// A name as code: no name ends it, or begins something else.
pub fn code(name: &str) -> String {
    let name = escape::line(name).replace('`', "'");
    format!("`{name}`")
}
