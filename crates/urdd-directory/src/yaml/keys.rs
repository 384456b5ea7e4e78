//! Keys in flow mappings whose colon is on another line. YAML 1.2 allows them; YAML 1.1 readers reject them.

use saphyr_parser::Span;

/// Message for such a key.
pub const TORN: &str = "a key in braces and its `:` on different lines make YAML 1.1 readers such as PyYAML refuse the file: write both on one line";

/// A forward scan of a text.
pub struct Keys<'y> {
    text: &'y str,
    /// Current position in characters, as the parser counts, and in bytes.
    index: usize,
    offset: usize,
}

impl<'y> Keys<'y> {
    /// Starts at the beginning of a text.
    pub fn new(text: &'y str) -> Self {
        Self { text, index: 0, offset: 0 }
    }

    /// Whether a line break is inside a key or before its colon. Explicit keys after `?` are exempt.
    pub fn is_torn(&mut self, key: Span) -> bool {
        let start = self.advance(key.start.index());
        let end = self.advance(key.end.index());
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

    /// Advances to a character index, and returns its byte offset.
    fn advance(&mut self, index: usize) -> usize {
        let rest = &self.text[self.offset..];
        let count = index.saturating_sub(self.index);
        let passed = rest.char_indices().nth(count);
        self.offset += passed.map_or(rest.len(), |(offset, _)| offset);
        self.index += count;
        self.offset
    }
}
