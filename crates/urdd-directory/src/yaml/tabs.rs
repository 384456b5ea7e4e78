//! Tabs outside quotes and comments. YAML 1.2 allows them where YAML 1.1 readers reject the file.

use saphyr_parser::{ScalarStyle, Span};

use super::super::position::Position;
use super::super::text_fault::{TextFault, TextFaultKind, TextFaults};

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
