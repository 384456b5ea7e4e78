//! Tabs outside quotes, which YAML 1.2 allows in places where YAML 1.1 readers refuse the file.

use saphyr_parser::{ScalarStyle, Span};

use super::super::position::Position;
use super::super::text_fault::{TextFault, TextFaultKind, TextFaults};

struct Tab {
    /// From 1, as the parser counts.
    line: usize,
    /// From 0, as the parser counts.
    column: usize,
    /// The column of the last `#` before it on its line.
    hash: Option<usize>,
}

/// The tabs of a text, taken from the front as the parser passes them.
pub struct Tabs {
    ahead: std::iter::Peekable<std::vec::IntoIter<Tab>>,
    /// Line and column at which the token before ended.
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
                        '\t' => tabs.push(Tab {
                            line: line + 1,
                            column,
                            hash,
                        }),
                        _ => {}
                    }
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
        let last = end.max(start);
        while let Some(tab) = self.ahead.next_if(|tab| (tab.line, tab.column) < last) {
            let Tab { line, column, hash } = tab;
            let between = (line, column) < bounds;
            let from = if self.passed.0 == line {
                self.passed.1
            } else {
                0
            };
            let comment = between && hash.is_some_and(|hash| hash >= from);
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
