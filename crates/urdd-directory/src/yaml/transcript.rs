//! Checks whether YAML mirrors a JSON text in bounded memory: a matrix is read one row at a time.

use std::collections::HashSet;
use std::fmt::{self, Write};

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};

use super::Expected;
use crate::canonical;
use crate::json::{Seed, State};

/// Whether a JSON text is a faultless object, and `yaml` is exactly its canonical YAML.
///
/// If not, [`crate::json::read`] and [`super::check_mirror`] report why.
pub fn is_mirrored(json: &str, yaml: &[u8]) -> bool {
    let state = State::default();
    let mut expected = Expected { rest: yaml };
    let mut deserializer = serde_json::Deserializer::from_str(json);
    let document = Follow { value: Seed::new(&state), indent: None, out: &mut expected };
    document.deserialize(&mut deserializer).is_ok()
        && deserializer.end().is_ok()
        && !state.has_repeated_key()
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
