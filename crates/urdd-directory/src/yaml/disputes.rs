//! Where YAML readers disagree: the end of a file without a final line break, keys in braces whose colon is on another
//! line, and tabs outside quotes and comments.

use std::ops::RangeInclusive;

use saphyr_parser::{ScalarStyle, Span};

use super::super::position::{Offsets, Position, position};
use super::super::text_fault::{TextFault, TextFaultKind, TextFaults};

/// Message for a scalar at the end of a file without a final line break.
pub const DISPUTED: &str =
    "readers disagree about the end of this text, since its last line has no line break: add one";

/// The end of a text.
pub struct End<'y> {
    text: &'y str,
    /// Number of characters, if the final line break is missing.
    open: Option<usize>,
}

impl<'y> End<'y> {
    /// Finds the end.
    pub fn new(text: &'y str) -> Self {
        let is_open = !text.ends_with(['\n', '\r']);
        Self { text, open: is_open.then(|| text.chars().count()) }
    }

    /// Whether a block scalar ends at the end of the file without a line break. Some readers add one.
    pub fn is_disputed(&self, scalar: &str, style: ScalarStyle, span: Span) -> bool {
        matches!(style, ScalarStyle::Literal | ScalarStyle::Folded)
            && scalar.ends_with('\n')
            && self.open.is_some_and(|count| span.end.index() >= count)
    }

    /// Limits a position to the end of the text: the parser assumes a final line break, and may report a line that does
    /// not exist.
    pub fn at_most(&self, at: Position) -> Position {
        at.min(position(self.text, self.text.len()))
    }
}

/// Message for a key in a flow mapping whose colon is on another line. YAML 1.2 allows it; YAML 1.1 readers reject it.
pub const TORN: &str = "a key in braces and its `:` on different lines make YAML 1.1 readers such as PyYAML refuse the file: write both on one line";

/// A forward scan of a text.
pub struct Keys<'y> {
    text: &'y str,
    offsets: Offsets<'y>,
}

impl<'y> Keys<'y> {
    /// Starts at the beginning of a text.
    pub fn new(text: &'y str) -> Self {
        Self { text, offsets: Offsets::new(text) }
    }

    /// Whether a line break is inside a key or before its colon. Explicit keys after `?` are exempt.
    pub fn is_torn(&mut self, key: Span) -> bool {
        let start = self.offsets.bytes(key.start.index());
        let end = self.offsets.bytes(key.end.index());
        let before = &self.text[..start];
        let space = before.trim_end();
        if space.len() < before.len() && space.ends_with('?') {
            return false;
        }
        let key = self.text[start..end].trim_end();
        if key.contains(['\n', '\r']) {
            return true;
        }
        let mut broken = false;
        let mut rest = &self.text[start + key.len()..];
        loop {
            rest = rest.trim_start_matches([' ', '\t']);
            if rest.starts_with(['\n', '\r']) {
                broken = true;
                rest = &rest[1..];
            } else if rest.starts_with('#') {
                rest = rest.trim_start_matches(|c| !matches!(c, '\n' | '\r'));
            } else {
                return broken && rest.starts_with(':');
            }
        }
    }
}

/// Message for a line of a flow collection that is no farther in than the value around it.
pub const OUTDENTED: &str = "a line in brackets or braces is not indented more than the value around it: write spaces before it";

/// The lines of a text, found when they are first needed.
pub struct Outdents<'y> {
    text: &'y str,
    lines: Vec<&'y str>,
}

impl<'y> Outdents<'y> {
    /// Starts without the lines.
    pub fn new(text: &'y str) -> Self {
        Self { text, lines: Vec::new() }
    }

    /// The first of these lines, from 1, that begins before or at a column, from 1. Empty lines and comments may.
    pub fn find(&mut self, lines: RangeInclusive<usize>, column: usize) -> Option<Position> {
        if lines.is_empty() {
            return None;
        }
        if self.lines.is_empty() {
            self.lines = self.text.lines().collect();
        }
        lines.into_iter().find_map(|number| {
            let line = self.lines.get(number - 1)?;
            let begins = line.trim_start_matches(' ');
            let before = line.len() - begins.len();
            let counts = !begins.is_empty() && !begins.starts_with('#');
            (counts && before < column).then(|| Position::of(number, before + 1))
        })
    }
}

const BETWEEN_TOKENS: &str = "a tab between tokens or in an unquoted scalar makes YAML 1.1 readers such as PyYAML refuse the file: write spaces";
const IN_BLOCK_SCALAR: &str =
    "a tab in a block scalar: write the text in double quotes, and the tab as \\t";

struct Tab {
    /// From 1, as in the parser.
    line: usize,
    /// From 0, as in the parser.
    column: usize,
    /// Column of the last `#` before it on its line.
    hash: Option<usize>,
}

/// The tabs of a text, consumed in step with the parser.
pub struct Tabs {
    ahead: std::iter::Peekable<std::vec::IntoIter<Tab>>,
    /// Line and column of the previous token's end.
    passed: (usize, usize),
}

impl Tabs {
    /// Finds all tabs.
    pub fn find(text: &str) -> Self {
        let mut tabs = Vec::new();
        if text.contains('\t') {
            let text = text.strip_suffix('\n').unwrap_or(text);
            for (line, content) in text.split('\n').enumerate() {
                let mut hash = None;
                for (column, c) in content.chars().enumerate() {
                    match c {
                        '#' => hash = Some(column),
                        '\t' => tabs.push(Tab { line: line + 1, column, hash }),
                        _ => {}
                    }
                }
            }
        }
        Self { ahead: tabs.into_iter().peekable(), passed: (1, 0) }
    }

    /// Reports the tabs up to the end of a token, except in quotes and comments.
    pub fn pass(&mut self, span: Span, style: Option<ScalarStyle>, faults: &mut TextFaults) {
        if self.ahead.peek().is_none() {
            return;
        }
        let start = (span.start.line(), span.start.col());
        let end = (span.end.line(), span.end.col());
        let (is_quoted, is_block) = match style {
            Some(ScalarStyle::SingleQuoted | ScalarStyle::DoubleQuoted) => (true, false),
            Some(ScalarStyle::Literal | ScalarStyle::Folded) => (false, true),
            Some(ScalarStyle::Plain) | None => (false, false),
        };
        // The span of a bracket includes the spaces and the comment after it. That of a block scalar begins after its
        // header and the comment there.
        let bounds = if style.is_some() { start } else { end };
        let last = end.max(start);
        while let Some(tab) = self.ahead.next_if(|tab| (tab.line, tab.column) < last) {
            let Tab { line, column, hash } = tab;
            let between = (line, column) < bounds;
            let from = if self.passed.0 == line { self.passed.1 } else { 0 };
            let comment = between && hash.is_some_and(|hash| hash >= from);
            if comment || (is_quoted && !between) {
                continue;
            }
            let message = if is_block && !between { IN_BLOCK_SCALAR } else { BETWEEN_TOKENS };
            faults.add(TextFaultKind::YamlSyntax, || {
                TextFault::new(TextFaultKind::YamlSyntax, message)
                    .at(Position::of(line, column + 1))
            });
        }
        self.passed = self.passed.max(end);
    }
}
