//! Reads untrusted JSON, and reports every fault of the text with its position.

use std::cell::Cell;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Number, Value};

use crate::json_scan;
use crate::limits::DEPTH_LIMIT;
use crate::position::{LineIndex, TextFault, TextFaultKind, TextFaults, UnreadableText, position};

/// A JSON file with a readable value.
#[derive(Debug, Clone, PartialEq)]
pub struct JsonDocument {
    /// The text, without a byte order mark.
    pub text: String,
    /// The parsed value. For duplicate members, it has the last value at the position of the first.
    pub value: Value,
    /// Faults that leave the value readable: a byte order mark, duplicate members.
    pub faults: TextFaults,
}

/// Reads one JSON document.
///
/// # Errors
/// If there is no usable value: not UTF-8, not JSON, a number that is not finite, or nesting beyond [`DEPTH_LIMIT`].
pub fn read(bytes: &[u8]) -> Result<JsonDocument, UnreadableText> {
    let mut faults = TextFaults::default();
    let kinds = [TextFaultKind::ByteOrderMark, TextFaultKind::NotUtf8];
    let text = match decode(bytes, kinds, &mut faults) {
        Ok(text) => text.to_owned(),
        Err(fault) => {
            let first = fault_before(bytes).unwrap_or(fault);
            return Err(unreadable(faults, first));
        }
    };
    let state = State::default();
    let value = match parse(&text, &state) {
        Ok(value) => value,
        Err(error) => {
            return Err(unreadable(faults, explain(&text, &error, state.too_deep.get())));
        }
    };
    if state.repeated_key.get() {
        report_repeated_keys(&text, &mut faults);
    }
    Ok(JsonDocument { text, value, faults })
}

fn parse(text: &str, state: &State) -> serde_json::Result<Value> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let value = Seed::new(state).deserialize(&mut deserializer)?;
    deserializer.end().map(|()| value)
}

/// The fault of a text that is not UTF-8 before its first byte that is not: the first fault of a file is its cause.
fn fault_before(bytes: &[u8]) -> Option<TextFault> {
    let rest = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let text = rest.utf8_chunks().next()?.valid();
    let state = State::default();
    let error = parse(text, &state).err().filter(|error| !error.is_eof())?;
    Some(explain(text, &error, state.too_deep.get()))
}

fn unreadable(mut faults: TextFaults, fault: TextFault) -> UnreadableText {
    faults.push(fault);
    UnreadableText { faults }
}

/// Faults noted while parsing. A second pass finds their positions if needed.
#[derive(Default)]
pub(super) struct State {
    /// Whether an object has duplicate members.
    pub repeated_key: Cell<bool>,
    too_deep: Cell<bool>,
}

/// Builds a [`Value`] like serde_json, and notes faults that serde_json ignores.
#[derive(Clone, Copy)]
pub(super) struct Seed<'s> {
    state: &'s State,
    depth: usize,
}

impl<'s> Seed<'s> {
    /// The seed for the document.
    pub fn new(state: &'s State) -> Self {
        Seed { state, depth: 0 }
    }

    /// The seed for the elements of this value, a list or an object.
    pub fn inner<E: serde::de::Error>(self) -> Result<Self, E> {
        if self.depth >= DEPTH_LIMIT {
            self.state.too_deep.set(true);
            return Err(E::custom("too deep"));
        }
        Ok(Self { depth: self.depth + 1, ..self })
    }
}

impl<'de> DeserializeSeed<'de> for Seed<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        deserializer.deserialize_any(self)
    }
}

macro_rules! scalars {
    ($($visit:ident: $type:ty),*) => {$(
        fn $visit<E>(self, value: $type) -> Result<Value, E> {
            Ok(Value::from(value))
        }
    )*};
}

impl<'de> Visitor<'de> for Seed<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    scalars!(visit_bool: bool, visit_i64: i64, visit_u64: u64, visit_str: &str);

    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<Value, E> {
        Number::from_f64(value).map(Value::Number).ok_or_else(|| E::custom("number out of range"))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Value, A::Error> {
        let inner = self.inner()?;
        let mut list = Vec::new();
        while let Some(element) = access.next_element_seed(inner)? {
            list.push(element);
        }
        Ok(Value::Array(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Value, A::Error> {
        let inner = self.inner::<A::Error>()?;
        let mut map = Map::new();
        while let Some(key) = access.next_key::<String>()? {
            let value = access.next_value_seed(inner)?;
            if map.insert(key, value).is_some() {
                self.state.repeated_key.set(true);
            }
        }
        Ok(Value::Object(map))
    }
}

const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// The text without a byte order mark, which it reports; or the fault that prevents decoding. The language reports them
/// under these kinds.
pub(super) fn decode<'a>(
    bytes: &'a [u8],
    [byte_order_mark, not_utf8]: [TextFaultKind; 2],
    faults: &mut TextFaults,
) -> Result<&'a str, TextFault> {
    let rest = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let start = bytes.len() - rest.len();
    if start > 0 {
        let fault = TextFault::new(
            byte_order_mark,
            "the file begins with a byte order mark, which many readers refuse: save it as UTF-8 without one",
        );
        faults.push(fault.at(position("", 0)));
    }
    std::str::from_utf8(rest).map_err(|error| {
        let valid = error.valid_up_to();
        let before = std::str::from_utf8(&rest[..valid]).unwrap_or_default();
        let offset = start + valid;
        let message = if bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF") {
            "the file is UTF-16: save it as UTF-8".to_owned()
        } else {
            format!("byte {offset} is not UTF-8: save the file as UTF-8")
        };
        let found = rest[valid..].first().map(|byte| format!("0x{byte:02X}"));
        TextFault { found, ..TextFault::new(not_utf8, message).at(position(before, valid)) }
    })
}

/// Reports the position of every duplicate key.
fn report_repeated_keys(text: &str, faults: &mut TextFaults) {
    let lines = LineIndex::new(text);
    json_scan::repeated_keys(text, |key| {
        faults.add(TextFaultKind::DuplicateKey, || {
            let key = key();
            let name = key.pointer.rsplit('/').next().unwrap_or_default();
            let message = format!(
                "the key `{}` occurs twice in its object: readers differ in which one they keep; remove one",
                name.replace("~1", "/").replace("~0", "~")
            );
            TextFault::new(TextFaultKind::DuplicateKey, message)
                .at(lines.position(key.offset))
                .of(key.pointer)
        });
    });
}

/// Converts serde_json's error to a fault.
fn explain(text: &str, error: &serde_json::Error, too_deep: bool) -> TextFault {
    let lines = LineIndex::new(text);
    // serde_json ends lines at `\n` only, counts columns in bytes, and names the last byte it read.
    let offset =
        if error.is_eof() { text.len() } else { offset_of(text, error.line(), error.column()) };
    let at = |offset: usize, kind, message: String| {
        TextFault::new(kind, message)
            .at(lines.position(offset))
            .of(json_scan::pointer_at(text, offset))
    };
    if too_deep {
        let message = format!("the nesting is deeper than {DEPTH_LIMIT} levels: flatten it");
        return TextFault::new(TextFaultKind::TooDeep, message).at(lines.position(offset));
    }
    let (start, word) = word_around(text, offset);
    if is_non_finite(word) {
        let message = format!("`{word}` is not a number in JSON: write null or a finite number");
        return at(start, TextFaultKind::NonFiniteNumber, message).finding(word);
    }
    let message = if text.trim().is_empty() {
        "the file is empty: a JSON value was expected".to_owned()
    } else if error.is_eof() {
        format!("the file ends early, before its JSON is complete: {}", reason(error))
    } else {
        format!("not JSON: {}", reason(error))
    };
    at(offset, TextFaultKind::Syntax, message)
}

/// serde_json's message without the position, which the fault gives in better units.
fn reason(error: &serde_json::Error) -> String {
    let whole = error.to_string();
    if whole.contains("hex escape") || whole.contains("surrogate") {
        return "an invalid escape, or half of a surrogate pair: write the character itself"
            .to_owned();
    }
    match whole.rfind(" at line ") {
        Some(end) => whole[..end].to_owned(),
        None => whole,
    }
}

fn offset_of(text: &str, line: usize, column: usize) -> usize {
    let before = text.split_inclusive('\n').take(line.saturating_sub(1));
    let start: usize = before.map(str::len).sum();
    let mut offset = (start + column.saturating_sub(1)).min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

/// The run of number and word characters around an offset, and its start.
fn word_around(text: &str, offset: usize) -> (usize, &str) {
    let bytes = text.as_bytes();
    let is_word =
        |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'+' | b'-' | b'.' | b'_');
    let before = bytes[..offset].iter().rev().take_while(|&&byte| is_word(byte)).count();
    let after = bytes[offset..].iter().take_while(|&&byte| is_word(byte)).count();
    let start = offset - before;
    (start, text.get(start..offset + after).unwrap_or_default())
}

fn is_non_finite(word: &str) -> bool {
    let bare = word.trim_start_matches(['+', '-']);
    let first = bare.split(['+', '-', '.']).next().unwrap_or_default();
    ["nan", "inf", "infinity"].iter().any(|name| first.eq_ignore_ascii_case(name))
        || (bare.starts_with(|c: char| c.is_ascii_digit())
            && word.parse::<f64>().is_ok_and(f64::is_infinite))
}
