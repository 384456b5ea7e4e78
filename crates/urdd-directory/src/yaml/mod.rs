//! Checks that a YAML file mirrors a JSON document.

mod compare;
mod disputes;
mod message;
mod open;
pub mod places;
pub mod scalar;
pub mod transcript;
pub mod words;

use std::fmt;

use serde_json::Value;

use super::canonical;
use super::json::decode;
use super::position::LineIndex;
use super::text_fault::{TextFault, TextFaultKind, TextFaults};
use message::excerpt;

pub use transcript::is_mirrored;

/// Reports everything that prevents every reader from reading the YAML file as `json`.
///
/// A file in the [canonical] form is compared byte by byte and not parsed. Any other is parsed. It may differ in
/// layout, comments, the order of keys, and in the notation of numbers and strings, as long as YAML 1.1 and YAML 1.2
/// agree on the values. Anchors are reported and never expanded.
pub fn check_mirror(yaml: &[u8], json: &Value) -> TextFaults {
    let mut faults = TextFaults::default();
    if is_canonical(yaml, json) {
        return faults;
    }
    let kinds = [TextFaultKind::YamlByteOrderMark, TextFaultKind::YamlNotUtf8];
    let text = match decode(yaml, kinds, &mut faults) {
        Ok(text) => text,
        Err(fault) => {
            faults.push(fault);
            return faults;
        }
    };
    if check_characters(text, &mut faults) {
        check_directives(text, &mut faults);
        compare::compare(text, json, &mut faults);
    }
    faults
}

/// Whether `yaml` is exactly the canonical YAML of `json`.
pub fn is_canonical(yaml: &[u8], json: &Value) -> bool {
    let mut expected = Expected { rest: yaml };
    canonical::yaml(json, &mut expected).is_ok() && expected.rest.is_empty()
}

/// Compares written text with the expected bytes, and fails at the first difference.
struct Expected<'a> {
    rest: &'a [u8],
}

impl fmt::Write for Expected<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.rest = self.rest.strip_prefix(text.as_bytes()).ok_or(fmt::Error)?;
        Ok(())
    }
}

/// Reports characters that YAML forbids, or that end a line in only one version of it. Returns whether the text can be
/// parsed.
fn check_characters(text: &str, faults: &mut TextFaults) -> bool {
    let is_usual = |byte: u8| matches!(byte, b'\t' | b'\n' | b'\r' | b' '..=b'~');
    if text.bytes().all(is_usual) {
        return true;
    }
    let mut lines = None;
    let mut readable = true;
    for (offset, c) in text.char_indices() {
        let kind = match c {
            '\t' | '\n' | '\r' | ' '..='~' => continue,
            '\u{85}' | '\u{2028}' | '\u{2029}' => TextFaultKind::YamlAmbiguousScalar,
            '\0'..='\u{9f}' | '\u{fffe}' | '\u{ffff}' => TextFaultKind::YamlSyntax,
            _ => continue,
        };
        let code = u32::from(c);
        faults.add(kind, || {
            let message = if kind == TextFaultKind::YamlSyntax {
                format!("U+{code:04X} is not allowed in YAML: write \\u{code:04x} in double quotes")
            } else {
                format!(
                    "U+{code:04X} ends a line in YAML 1.1, but not in YAML 1.2: write \\u{code:04x} in double quotes"
                )
            };
            let lines = lines.get_or_insert_with(|| LineIndex::new(text));
            TextFault::new(kind, message).at(lines.position(offset))
        });
        readable &= kind != TextFaultKind::YamlSyntax;
    }
    readable
}

/// Reports directives such as `%YAML`, which the parser does not expose.
fn check_directives(text: &str, faults: &mut TextFaults) {
    let mut offset = 0;
    for line in text.split_inclusive(['\n', '\r']) {
        if line.starts_with('%') {
            faults.add(TextFaultKind::YamlDirective, || {
                let message = format!(
                    "`{}` is a directive, which readers treat differently: remove it and the `---` after it",
                    excerpt(line.trim_end())
                );
                TextFault::new(TextFaultKind::YamlDirective, message)
                    .at(super::position::position(text, offset))
            });
        } else if !line.trim().is_empty() && !line.trim_start().starts_with('#') {
            return;
        }
        offset += line.len();
    }
}
