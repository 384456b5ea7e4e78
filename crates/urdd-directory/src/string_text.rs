//! The canonical form of strings. [`super::canonical`] specifies it.

use std::fmt::{self, Write};

/// The output language.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// JSON.
    Json,
    /// YAML.
    Yaml,
}

/// A string in double quotes, as YAML.
pub fn yaml_quoted(text: &str) -> String {
    let mut quoted = String::new();
    let _ = write_quoted(text, Language::Yaml, &mut quoted);
    quoted
}

/// Writes a string: plain if the language allows it and it is safe, else quoted.
pub fn write_string(text: &str, language: Language, out: &mut impl Write) -> fmt::Result {
    if language == Language::Yaml && is_plain(text) {
        out.write_str(text)
    } else {
        write_quoted(text, language, out)
    }
}

/// Whether every YAML reader takes the unquoted text for a string.
pub fn is_plain(text: &str) -> bool {
    const WORDS: [&str; 9] = ["y", "n", "yes", "no", "on", "off", "true", "false", "null"];
    let mut bytes = text.bytes();
    bytes.next().is_some_and(|b| b.is_ascii_alphabetic() || b == b'_')
        && bytes.all(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'-' | b'.' | b'/'))
        && !(text.len() <= 5 && WORDS.iter().any(|word| text.eq_ignore_ascii_case(word)))
}

/// Writes a string in double quotes.
pub fn write_quoted(text: &str, language: Language, out: &mut impl Write) -> fmt::Result {
    out.write_char('"')?;
    let mut rest = text;
    while let Some(at) = rest.find(|c| must_escape(c, language)) {
        out.write_str(&rest[..at])?;
        let mut after = rest[at..].chars();
        match after.next() {
            Some('"') => out.write_str("\\\"")?,
            Some('\\') => out.write_str("\\\\")?,
            Some('\u{8}') => out.write_str("\\b")?,
            Some('\t') => out.write_str("\\t")?,
            Some('\n') => out.write_str("\\n")?,
            Some('\u{c}') => out.write_str("\\f")?,
            Some('\r') => out.write_str("\\r")?,
            Some(c) => write!(out, "\\u{:04x}", u32::from(c))?,
            None => {}
        }
        rest = after.as_str();
    }
    out.write_str(rest)?;
    out.write_char('"')
}

fn must_escape(c: char, language: Language) -> bool {
    match c {
        '"' | '\\' | '\0'..='\u{1f}' => true,
        // Not printable in YAML, or a line break in YAML 1.1.
        '\u{7f}'..='\u{9f}' | '\u{2028}' | '\u{2029}' | '\u{feff}' | '\u{fffe}' | '\u{ffff}' => {
            language == Language::Yaml
        }
        _ => false,
    }
}
