//! Tabs outside quotes, which YAML 1.2 allows in places where YAML 1.1 readers refuse the file.

use saphyr_parser::{ScalarStyle, Span};

use super::position::Position;
use super::text_fault::{TextFault, TextFaultKind, TextFaults};

/// The tabs of a text, taken from the front as the parser passes them.
pub struct Tabs<'y> {
    /// 1-based line, 0-based column, and the part of the line that stands before the tab.
    ahead: std::iter::Peekable<std::vec::IntoIter<(usize, usize, &'y str)>>,
    /// Line and column at which the token before ended.
    passed: (usize, usize),
}

impl<'y> Tabs<'y> {
    /// Finds all tabs.
    pub fn find(text: &'y str) -> Self {
        let mut tabs = Vec::new();
        if text.contains('\t') {
            let text = text.strip_suffix('\n').unwrap_or(text);
            for (line, content) in text.split('\n').enumerate() {
                for (at, _) in content.match_indices('\t') {
                    let before = &content[..at];
                    tabs.push((line + 1, before.chars().count(), before));
                }
            }
        }
        Self {
            ahead: tabs.into_iter().peekable(),
            passed: (1, 0),
        }
    }

    /// Reports the tabs up to the end of a token, but those in comments, quotes and block scalars.
    pub fn pass(&mut self, span: Span, style: Option<ScalarStyle>, faults: &mut TextFaults) {
        if self.ahead.peek().is_none() {
            return;
        }
        let start = (span.start.line(), span.start.col());
        let end = (span.end.line(), span.end.col());
        let quoted = style.is_some_and(|style| style != ScalarStyle::Plain);
        // A bracket's span goes on over the spaces and the comment behind it.
        let bounds = if style.is_some() { start } else { end };
        while let Some((line, column, before)) =
            self.ahead.next_if(|tab| (tab.0, tab.1) < end.max(start))
        {
            let between = (line, column) < bounds;
            let from = if self.passed.0 == line {
                self.passed.1
            } else {
                0
            };
            let comment = between && before.chars().skip(from).any(|c| c == '#');
            if comment || (quoted && !between) {
                continue;
            }
            let message = "a tab between tokens or in an unquoted scalar makes YAML 1.1 readers such as PyYAML refuse the file: write spaces";
            faults.add(TextFaultKind::YamlSyntax, || {
                let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
                TextFault::new(TextFaultKind::YamlSyntax, message).at(Position {
                    line: count(line),
                    column: count(column + 1),
                })
            });
        }
        self.passed = self.passed.max(end);
    }
}
