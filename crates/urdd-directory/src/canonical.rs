//! The canonical form of a document, as JSON and as YAML. SPEC 3.3 defines it.
//!
//! It is unique, so that a validator can compare bytes, and producers in any language write the same text. Members keep the
//! order of the document. An inline value is one that stands on one line in both languages (SPEC 3.3.2).

use std::fmt::{self, Write};

use serde_json::{Number, Value};

/// Longest YAML key without the `? ` form, characters.
const LONGEST_SIMPLE_KEY: usize = 1000;

/// Writes the canonical JSON of `value`.
///
/// Recursive: limit the nesting of untrusted input to [`crate::limits::DEPTH_LIMIT`].
///
/// # Errors
/// Only those of `out`.
pub fn json(value: &Value, out: &mut impl Write) -> fmt::Result {
    json_node(value, 0, out)?;
    out.write_char('\n')
}

/// The canonical JSON of `value` as a string.
pub fn json_string(value: &Value) -> String {
    written(|text| json(value, text))
}

/// Writes the canonical YAML of `value`.
///
/// Recursive: limit the nesting of untrusted input to [`crate::limits::DEPTH_LIMIT`].
///
/// # Errors
/// Only those of `out`.
pub fn yaml(value: &Value, out: &mut impl Write) -> fmt::Result {
    if is_inline(value) {
        inline(value, Language::Yaml, out)?;
        out.write_char('\n')
    } else {
        yaml_block(value, 0, false, out)
    }
}

/// The canonical YAML of `value` as a string.
pub fn yaml_string(value: &Value) -> String {
    written(|text| yaml(value, text))
}

/// The inline form of a scalar or an inline list in YAML, for messages.
pub(super) fn yaml_inline(value: &Value) -> String {
    written(|text| inline(value, Language::Yaml, text))
}

/// Writes into a String, which cannot fail.
fn written(write: impl FnOnce(&mut String) -> fmt::Result) -> String {
    let mut text = String::new();
    let _ = write(&mut text);
    text
}

fn is_inline(value: &Value) -> bool {
    match value {
        Value::Array(list) => !list.iter().any(|v| v.is_array() || v.is_object()),
        Value::Object(map) => map.is_empty(),
        _ => true,
    }
}

fn inline(value: &Value, language: Language, out: &mut impl Write) -> fmt::Result {
    match value {
        Value::Null => out.write_str("null"),
        Value::Bool(true) => out.write_str("true"),
        Value::Bool(false) => out.write_str("false"),
        Value::Number(number) => write_number(number, out),
        Value::String(text) => write_string(text, language, out),
        Value::Array(list) => {
            out.write_char('[')?;
            for (index, element) in list.iter().enumerate() {
                if index > 0 {
                    out.write_str(", ")?;
                }
                inline(element, language, out)?;
            }
            out.write_char(']')
        }
        Value::Object(_) => out.write_str("{}"),
    }
}

/// Writes a value as JSON, starting at the current column.
pub(super) fn json_node<W: Write>(value: &Value, indent: usize, out: &mut W) -> fmt::Result {
    match value {
        Value::Array(list) if !is_inline(value) => {
            json_block(['[', ']'], list, indent, out, |element, out| {
                json_node(element, indent + 2, out)
            })
        }
        Value::Object(map) if !map.is_empty() => {
            json_block(['{', '}'], map, indent, out, |(key, member), out| {
                write_quoted(key, Language::Json, out)?;
                out.write_str(": ")?;
                json_node(member, indent + 2, out)
            })
        }
        _ => inline(value, Language::Json, out),
    }
}

/// Writes the elements of a list, or the members of an object, each on a line of its own. There is at least one.
pub(super) fn json_block<T, W: Write>(
    [open, close]: [char; 2],
    items: impl IntoIterator<Item = T>,
    indent: usize,
    out: &mut W,
    mut write: impl FnMut(T, &mut W) -> fmt::Result,
) -> fmt::Result {
    let mut before = open;
    for item in items {
        out.write_char(before)?;
        out.write_char('\n')?;
        before = ',';
        spaces(indent + 2, out)?;
        write(item, out)?;
    }
    out.write_char('\n')?;
    spaces(indent, out)?;
    out.write_char(close)
}

/// Writes a value that is not inline. With `begun`, the first line is already indented.
fn yaml_block(value: &Value, indent: usize, begun: bool, out: &mut impl Write) -> fmt::Result {
    match value {
        Value::Object(map) => {
            for (index, (key, member)) in map.iter().enumerate() {
                if index > 0 || !begun {
                    spaces(indent, out)?;
                }
                written_key(key, indent, out)?;
                yaml_rest(member, indent + 2, out)?;
            }
            Ok(())
        }
        Value::Array(list) => {
            list.iter().try_for_each(|element| yaml_element(element, indent, out))
        }
        _ => inline(value, Language::Yaml, out),
    }
}

/// Writes an element of a list that is not inline.
pub(super) fn yaml_element(element: &Value, indent: usize, out: &mut impl Write) -> fmt::Result {
    spaces(indent, out)?;
    out.write_char('-')?;
    if element.is_object() && !is_inline(element) {
        out.write_char(' ')?;
        yaml_block(element, indent + 2, true, out)
    } else {
        yaml_rest(element, indent + 2, out)
    }
}

/// Writes the key of a member on its own line, up to the colon.
pub(super) fn yaml_key(key: &str, indent: usize, out: &mut impl Write) -> fmt::Result {
    spaces(indent, out)?;
    written_key(key, indent, out)
}

fn written_key(key: &str, indent: usize, out: &mut impl Write) -> fmt::Result {
    // An escape is up to six characters for one byte, so shorter keys cannot reach the limit.
    if key.len() > LONGEST_SIMPLE_KEY / 6 {
        let long = written(|long| write_string(key, Language::Yaml, long));
        match long.chars().count() > LONGEST_SIMPLE_KEY {
            true => write!(out, "? {long}\n{:indent$}", "")?,
            false => out.write_str(&long)?,
        }
    } else {
        write_string(key, Language::Yaml, out)?;
    }
    out.write_char(':')
}

/// Writes the value after the colon of a member or the dash of an element.
pub(super) fn yaml_rest(value: &Value, indent: usize, out: &mut impl Write) -> fmt::Result {
    if is_inline(value) {
        out.write_char(' ')?;
        inline(value, Language::Yaml, out)?;
        out.write_char('\n')
    } else {
        out.write_char('\n')?;
        yaml_block(value, indent, false, out)
    }
}

fn spaces(mut count: usize, out: &mut impl Write) -> fmt::Result {
    const MANY: &str = "                                                                ";
    while count > 0 {
        let now = count.min(MANY.len());
        out.write_str(&MANY[..now])?;
        count -= now;
    }
    Ok(())
}

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
    written(|quoted| write_quoted(text, Language::Yaml, quoted))
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

/// Smaller magnitudes have an exponent. The same bound as Python's `repr`.
const SMALLEST_WITHOUT_EXPONENT: f64 = 1e-4;
/// Magnitudes from here on have an exponent. The same bound as Python's `repr`.
const LARGEST_WITHOUT_EXPONENT: f64 = 1e16;

/// Writes a number so that JSON, YAML 1.1 and YAML 1.2 read the same value.
///
/// Integers are decimal digits. A float is the shortest decimal that reads back as the same 64-bit float. Zero, of
/// either sign, is `0.0`. A magnitude of at least 10^-4 and below 10^16 has no exponent and at least one digit on each
/// side of the point (`0.0001`, `3.0`). Any other has one digit before the point, at least one after it, `e`, a sign,
/// and the exponent without leading zeros (`1.0e-5`, `1.25e+22`).
pub fn write_number(number: &Number, out: &mut impl Write) -> fmt::Result {
    match number.as_f64() {
        Some(x) if number.is_f64() => write_float(x, out),
        _ => write!(out, "{number}"),
    }
}

/// Writes a float like [`write_number`]. The caller ensures that it is finite.
pub fn write_float(x: f64, out: &mut impl Write) -> fmt::Result {
    let magnitude = x.abs();
    if magnitude == 0.0 {
        return out.write_str("0.0");
    }
    if (SMALLEST_WITHOUT_EXPONENT..LARGEST_WITHOUT_EXPONENT).contains(&magnitude) {
        // serde_json prints floats several times faster than the standard library.
        let mut buffer = [0_u8; 40];
        let mut free = &mut buffer[..];
        let written = serde_json::to_writer(&mut free, &x).is_ok();
        let length = 40 - free.len();
        return match std::str::from_utf8(&buffer[..length]) {
            Ok(text) if written && text.contains('.') && !text.contains('e') => out.write_str(text),
            _ => write!(out, "{x:?}"),
        };
    }
    let text = format!("{x:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let point = if mantissa.contains('.') { "" } else { ".0" };
    let sign = if exponent.starts_with('-') { "" } else { "+" };
    write!(out, "{mantissa}{point}e{sign}{exponent}")
}
