//! Reads untrusted JSON, and reports every fault of the text with its position.

use std::cell::Cell;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Number, Value};

use super::json_fault::{decode, explain, report_repeated_keys};
use super::limits::DEPTH_LIMIT;
use super::text_fault::{TextFault, TextFaultKind, TextFaults, UnreadableText};

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
        Err(fault) => return Err(unreadable(faults, fault)),
    };
    let state = State::default();
    let mut deserializer = serde_json::Deserializer::from_str(&text);
    let parsed = Seed::new(&state)
        .deserialize(&mut deserializer)
        .and_then(|value| deserializer.end().map(|()| value));
    let value = match parsed {
        Ok(value) => value,
        Err(error) => {
            return Err(unreadable(faults, explain(&text, &error, state.too_deep.get())));
        }
    };
    if state.has_repeated_key() {
        report_repeated_keys(&text, &mut faults);
    }
    Ok(JsonDocument { text, value, faults })
}

fn unreadable(mut faults: TextFaults, fault: TextFault) -> UnreadableText {
    faults.push(fault);
    UnreadableText { faults }
}

/// Faults noted while parsing. A second pass finds their positions if needed.
#[derive(Default)]
pub(super) struct State {
    repeated_key: Cell<bool>,
    too_deep: Cell<bool>,
}

impl State {
    /// Whether an object has duplicate members.
    pub fn has_repeated_key(&self) -> bool {
        self.repeated_key.get()
    }
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
