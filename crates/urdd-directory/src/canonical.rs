//! The canonical form of a document, as JSON and as YAML.
//!
//! It is unique, so that a validator can compare bytes, and producers in any language write the same text.
//!
//! # Both languages
//!
//! Members keep the order of the document. Indentation is two spaces per level. Every line ends with `\n`, including
//! the last. A value is *inline* if it is a scalar, an empty object, or a list without objects and lists in it (also
//! the empty list). An inline list is `[`, its elements separated by `, `, and `]`. An empty object is `{}`. Numbers
//! follow [`super::number_text::write`].
//!
//! # JSON
//!
//! An inline value is on one line. In any other value, each member (`"key": value`) or element starts on its own line,
//! one level deeper than the brackets. In strings, `"` and `\` are escaped with `\`; U+0008, U+0009, U+000A, U+000C and
//! U+000D are `\b`, `\t`, `\n`, `\f`, `\r`; other characters below U+0020 are `\u` and four lower-case hexadecimal
//! digits. All other characters are unescaped. (Python: `json.dumps(s, ensure_ascii=False)`.)
//!
//! # YAML
//!
//! No `---`, no comments. The value of the document begins in column one. *n* is the current indentation (0 for the
//! document):
//!
//! - An inline value is written in its inline form.
//! - A non-empty object: for each member a line of *n* spaces, the key, and `:`. An inline value follows after one
//!   space; any other value follows on the next lines, with *n* + 2.
//! - A list that is not inline: for each element a line of *n* spaces and `-`. An inline element follows after one
//!   space. An object follows after one space with its first member on the same line and its other members below that
//!   one, with *n* + 2. A list follows on the next lines, with *n* + 2: the dash is alone on its line.
//! - `null`, `true`, `false` are written as such.
//! - A string, as key or as value, is plain if it is an ASCII letter or `_` followed by any number of ASCII letters,
//!   digits, `_`, `-`, `.` and `/`, and is not one of `y`, `n`, `yes`, `no`, `on`, `off`, `true`, `false`, `null` in
//!   any mixture of cases. Every other string is in double quotes with the escapes of JSON, plus `\u` and four
//!   lower-case hexadecimal digits for U+007F to U+009F, U+2028, U+2029, U+FEFF, U+FFFE and U+FFFF. Characters above
//!   U+FFFF are unescaped, never a pair of escapes.
//! - A key whose written form is longer than 1,000 characters (parsers reject simple keys over 1,024) is written as
//!   `? ` and the key; then on the next line *n* spaces and `:`, and the value as after any other key.

use std::fmt::{self, Write};

use serde_json::{Map, Value};

use super::number_text;
use super::string_text::{Language, write_quoted, write_string};

/// Longest YAML key without the `? ` form, characters.
const LONGEST_SIMPLE_KEY: usize = 1000;

/// Writes the canonical JSON of `value`.
///
/// Recursive: limit the nesting of untrusted input to [`super::limits::DEPTH_LIMIT`].
///
/// # Errors
/// Only those of `out`.
pub fn json(value: &Value, out: &mut impl Write) -> fmt::Result {
    json_node(value, 0, out)?;
    out.write_char('\n')
}

/// The canonical JSON of `value` as a string.
pub fn json_string(value: &Value) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = json(value, &mut text);
    text
}

/// Writes the canonical YAML of `value`.
///
/// Recursive: limit the nesting of untrusted input to [`super::limits::DEPTH_LIMIT`].
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
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = yaml(value, &mut text);
    text
}

/// The inline form of a scalar or an inline list in YAML, for messages.
pub(super) fn yaml_inline(value: &Value) -> String {
    let mut text = String::new();
    let _ = inline(value, Language::Yaml, &mut text);
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
        Value::Number(number) => number_text::write(number, out),
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
pub(super) fn json_node(value: &Value, indent: usize, out: &mut impl Write) -> fmt::Result {
    match value {
        Value::Array(list) if !is_inline(value) => {
            let mut before = "[\n";
            for element in list {
                out.write_str(before)?;
                before = ",\n";
                spaces(indent + 2, out)?;
                json_node(element, indent + 2, out)?;
            }
            out.write_char('\n')?;
            spaces(indent, out)?;
            out.write_char(']')
        }
        Value::Object(map) if !map.is_empty() => {
            let mut before = "{\n";
            for (key, member) in map {
                out.write_str(before)?;
                before = ",\n";
                spaces(indent + 2, out)?;
                write_quoted(key, Language::Json, out)?;
                out.write_str(": ")?;
                json_node(member, indent + 2, out)?;
            }
            out.write_char('\n')?;
            spaces(indent, out)?;
            out.write_char('}')
        }
        _ => inline(value, Language::Json, out),
    }
}

/// Writes a value that is not inline. With `begun`, the first line is already indented.
fn yaml_block(value: &Value, indent: usize, begun: bool, out: &mut impl Write) -> fmt::Result {
    match value {
        Value::Object(map) => yaml_members(map, indent, begun, out),
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

fn yaml_members(
    map: &Map<String, Value>,
    indent: usize,
    begun: bool,
    out: &mut impl Write,
) -> fmt::Result {
    for (index, (key, member)) in map.iter().enumerate() {
        if index > 0 || !begun {
            spaces(indent, out)?;
        }
        written_key(key, indent, out)?;
        yaml_rest(member, indent + 2, out)?;
    }
    Ok(())
}

/// Writes the key of a member on its own line, up to the colon.
pub(super) fn yaml_key(key: &str, indent: usize, out: &mut impl Write) -> fmt::Result {
    spaces(indent, out)?;
    written_key(key, indent, out)
}

fn written_key(key: &str, indent: usize, out: &mut impl Write) -> fmt::Result {
    // An escape is up to six characters for one byte, so shorter keys cannot reach the limit.
    if key.len() > LONGEST_SIMPLE_KEY / 6 {
        write_long_key(key, indent, out)?;
    } else {
        write_string(key, Language::Yaml, out)?;
    }
    out.write_char(':')
}

fn write_long_key(key: &str, indent: usize, out: &mut impl Write) -> fmt::Result {
    let mut written = String::new();
    write_string(key, Language::Yaml, &mut written)?;
    if written.chars().count() <= LONGEST_SIMPLE_KEY {
        return out.write_str(&written);
    }
    out.write_str("? ")?;
    out.write_str(&written)?;
    out.write_char('\n')?;
    spaces(indent, out)
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
