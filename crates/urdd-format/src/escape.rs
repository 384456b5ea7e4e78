//! Makes untrusted text safe to print. A name in a URDD, a file path or a command-line argument may
//! hold characters that clear a terminal, reverse text or are invisible. Each is printed as its
//! escape, `\u{1b}`.

use std::borrow::Cow;
use std::fmt::Write;

use unicode_general_category::{GeneralCategory, get_general_category};

/// Whether a character must be escaped in a terminal, a log or a page: control characters (C0, DEL,
/// C1), line and paragraph separators, format characters (bidirectional controls, joiners, tags),
/// characters without a glyph, and unassigned code points.
pub fn is_hidden(c: char) -> bool {
    match c {
        ' '..='~' => false,
        // Letters and marks by category, but without a visible glyph: fillers, variation selectors.
        '\u{34f}'
        | '\u{115f}'
        | '\u{1160}'
        | '\u{17b4}'
        | '\u{17b5}'
        | '\u{180b}'..='\u{180f}'
        | '\u{2800}'
        | '\u{3164}'
        | '\u{fe00}'..='\u{fe0f}'
        | '\u{ffa0}'
        | '\u{e0000}'..='\u{e0fff}' => true,
        c => matches!(
            get_general_category(c),
            GeneralCategory::Control
                | GeneralCategory::Format
                | GeneralCategory::LineSeparator
                | GeneralCategory::ParagraphSeparator
                | GeneralCategory::Surrogate
                | GeneralCategory::Unassigned
        ),
    }
}

/// Escapes text that belongs on one line: a name, a path, a message. Escapes line breaks too, so
/// that no name can add a line.
pub fn line(text: &str) -> Cow<'_, str> {
    replaced(text, is_hidden, escape)
}

/// Escapes text of several lines. As [`line()`], but keeps line feeds.
pub fn lines(text: &str) -> Cow<'_, str> {
    replaced(text, |c| c != '\n' && is_hidden(c), escape)
}

/// Escapes the text of a JSON document. Hidden characters in its strings become JSON `\u` escapes,
/// so the document keeps its meaning. (JSON writers escape C0 only.)
pub fn json(text: &str) -> Cow<'_, str> {
    replaced(text, |c| c >= '\u{7f}' && is_hidden(c), escape_json)
}

/// Quotes a name on one line. Also escapes quotes and backslashes, so that the closing quote is unambiguous.
pub fn quoted(name: &str) -> String {
    let name = name.replace('\\', "\\\\").replace('"', "\\\"");
    format!("\"{}\"", line(&name))
}

/// Quotes a path or a name for a command line that a message suggests: in single quotes, unless every shell takes it for
/// one word.
pub fn shell(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "_./:@%+,-".contains(c);
    match !word.is_empty() && word.chars().all(is_plain) {
        true => line(word).into_owned(),
        false => format!("'{}'", line(word).replace('\'', "'\\''")),
    }
}

/// Maximum length of a code span, bytes.
const MAX_SPAN_BYTES: usize = 2_000;

/// A code span of Markdown: its fence is longer than any run of backticks in the text. Longer text is cut.
pub fn code_span(text: &str) -> String {
    // A runner of GitHub Actions takes what follows for a command, anywhere in a line.
    let text = line(text).replace("##[", "#\\u0023[");
    let mut starts = text.char_indices().map(|(at, _)| at);
    let end = starts.find(|at| *at > MAX_SPAN_BYTES);
    let (text, rest) = text.split_at(end.unwrap_or(text.len()));
    let more = if rest.is_empty() { "" } else { " …" };
    if text.is_empty() {
        return "(empty)".to_owned();
    }
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest + 1);
    let pad = match text.starts_with('`') || text.ends_with('`') || text.trim().is_empty() {
        true => " ",
        false => "",
    };
    format!("{fence}{pad}{text}{pad}{fence}{more}")
}

fn escape(c: char, out: &mut String) {
    match c {
        '\n' => out.push_str("\\n"),
        '\r' => out.push_str("\\r"),
        '\t' => out.push_str("\\t"),
        c => {
            let _ = write!(out, "\\u{{{:x}}}", u32::from(c));
        }
    }
}

fn escape_json(c: char, out: &mut String) {
    for unit in c.encode_utf16(&mut [0; 2]) {
        let _ = write!(out, "\\u{unit:04x}");
    }
}

fn replaced(
    text: &str,
    wanted: impl Fn(char) -> bool,
    escape: fn(char, &mut String),
) -> Cow<'_, str> {
    let Some(first) = text.find(&wanted) else {
        return Cow::Borrowed(text);
    };
    let mut out = String::with_capacity(text.len() + 16);
    out.push_str(&text[..first]);
    for c in text[first..].chars() {
        if wanted(c) { escape(c, &mut out) } else { out.push(c) }
    }
    Cow::Owned(out)
}
