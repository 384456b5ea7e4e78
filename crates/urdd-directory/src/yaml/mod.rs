//! Checks that a YAML file mirrors a JSON document.

mod aliases;
mod compare;
mod open;
pub mod places;
pub mod scalar;
/// Reads a YAML file of another program.
pub mod words {
    pub use super::aliases::check;
    pub use super::places::{Words, WordsFault, read_words as read};
}

use std::collections::HashSet;
use std::fmt::{self, Write};

use open::excerpt;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};

use crate::canonical;
use crate::json::{Seed, State, decode};
use crate::position::{LineIndex, TextFault, TextFaultKind, TextFaults};

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

/// Whether a JSON text is a faultless object, and `yaml` is exactly its canonical YAML.
///
/// If not, [`crate::json::read`] and [`check_mirror`] report why.
pub fn is_mirrored(json: &str, yaml: &[u8]) -> bool {
    let state = State::default();
    let mut expected = Expected { rest: yaml };
    let mut deserializer = serde_json::Deserializer::from_str(json);
    let document = Follow { value: Seed::new(&state), indent: None, out: &mut expected };
    document.deserialize(&mut deserializer).is_ok()
        && deserializer.end().is_ok()
        && !state.repeated_key.get()
        && expected.rest.is_empty()
}

/// Writes a value as canonical YAML while parsing it.
struct Follow<'s, 'o, W> {
    value: Seed<'s>,
    /// The indentation for [`canonical::yaml_rest`]; `None` for the document itself.
    indent: Option<usize>,
    out: &'o mut W,
}

impl<W: Write> Follow<'_, '_, W> {
    fn write<E: Error>(self, value: &Value) -> Result<(), E> {
        let indent = self.indent.ok_or_else(no_object)?;
        canonical::yaml_rest(value, indent, self.out).map_err(E::custom)
    }
}

fn no_object<E: Error>() -> E {
    E::custom("the document is not an object")
}

impl<'de, W: Write> DeserializeSeed<'de> for Follow<'_, '_, W> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

macro_rules! scalars {
    ($($visit:ident: $type:ty),*) => {$(
        fn $visit<E: Error>(self, value: $type) -> Result<(), E> {
            let value = self.value.$visit(value)?;
            self.write(&value)
        }
    )*};
}

impl<'de, W: Write> Visitor<'de> for Follow<'_, '_, W> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        self.write(&Value::Null)
    }

    scalars!(visit_bool: bool, visit_i64: i64, visit_u64: u64, visit_f64: f64, visit_str: &str);

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<(), A::Error> {
        let inner = self.value.inner()?;
        let indent = self.indent.ok_or_else(no_object)?;
        // A list is on one line unless it contains a list or an object: buffer its scalars until that is known.
        let mut held = Some(Vec::new());
        while let Some(element) = access.next_element_seed(inner)? {
            let is_scalar = !element.is_array() && !element.is_object();
            match &mut held {
                Some(scalars) if is_scalar => scalars.push(element),
                _ => {
                    if let Some(scalars) = held.take() {
                        self.out.write_char('\n').map_err(A::Error::custom)?;
                        for scalar in &scalars {
                            canonical::yaml_element(scalar, indent, self.out)
                                .map_err(A::Error::custom)?;
                        }
                    }
                    canonical::yaml_element(&element, indent, self.out)
                        .map_err(A::Error::custom)?;
                }
            }
        }
        match held {
            Some(scalars) => self.write(&Value::Array(scalars)),
            None => Ok(()),
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<(), A::Error> {
        let inner = self.value.inner()?;
        let indent = self.indent.unwrap_or_default();
        let mut keys = HashSet::new();
        while let Some(key) = access.next_key::<String>()? {
            if keys.is_empty() && self.indent.is_some() {
                self.out.write_char('\n').map_err(A::Error::custom)?;
            }
            canonical::yaml_key(&key, indent, self.out).map_err(A::Error::custom)?;
            access.next_value_seed(Follow {
                value: inner,
                indent: Some(indent + 2),
                out: &mut *self.out,
            })?;
            if !keys.insert(key) {
                return Err(A::Error::custom("a key occurs twice"));
            }
        }
        if keys.is_empty() { self.write(&Value::Object(Map::new())) } else { Ok(()) }
    }
}
