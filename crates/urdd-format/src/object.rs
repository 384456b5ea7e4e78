//! The macros behind those of `types.rs`, which declare the format's types so that serde accepts exactly what the
//! published schema accepts.
//!
//! serde's own derive is laxer than a JSON Schema in some places (it reads a struct from an array,
//! a missing `Option` as `None`, a unit variant from an object) and stricter in others (`1.0` is
//! not an integer). These macros close both gaps. They also allow the keys that SPEC reserves:
//! `x_…` in every object, and `$schema` at the top of a document.

use std::fmt;

use schemars::Schema;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, Visitor};
use serde_json::{Value, json};

/// Prefix of extension keys, allowed in every object of the format.
pub const EXTENSION_PREFIX: &str = "x_";

/// Declares a JSON object: every key required (an absent value is `null`), no unknown keys. `$document` says whether it
/// is a whole document, where `$schema` is allowed too, and `$close` makes its schema say so.
macro_rules! object {
    ($document:literal, $close:path, $(#[$meta:meta])* pub struct $name:ident {
        $($(#[$fmeta:meta])* pub $field:ident: $ty:ty $(where { $($keyword:ident: $says:literal),* })?,)*
    }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
        #[schemars(transform = $close)]
        pub struct $name {$(
            $(#[$fmeta])*
            $(#[schemars(transform = $crate::annotations::Annotations {
                $($keyword: $says,)* ..$crate::annotations::Annotations::NONE
            })])?
            pub $field: $ty,
        )*}

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                const FIELDS: &[&str] = &[$(stringify!($field)),*];
                #[allow(non_camel_case_types, clippy::enum_variant_names)]
                enum Slot { $($field),* }
                struct ObjectVisitor;

                impl<'de> serde::de::Visitor<'de> for ObjectVisitor {
                    type Value = $name;

                    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        f.write_str(concat!("an object (", stringify!($name), ")"))
                    }

                    fn visit_map<A: serde::de::MapAccess<'de>>(self, mut map: A) -> Result<$name, A::Error> {
                        use serde::de::Error;
                        $(let mut $field: Option<$ty> = None;)*
                        while let Some(slot) = $crate::object::next_field(&mut map, FIELDS, $document)? {
                            $(if slot == Slot::$field as usize {
                                if $field.replace(map.next_value()?).is_some() {
                                    return Err(A::Error::duplicate_field(stringify!($field)));
                                }
                                continue;
                            })*
                        }
                        Ok($name {
                            $($field: $field.ok_or_else(|| A::Error::missing_field(stringify!($field)))?,)*
                        })
                    }
                }
                deserializer.deserialize_map(ObjectVisitor)
            }
        }
    };
}

/// The JSON word of an enumeration value: its name, unless another is given.
macro_rules! word {
    ($variant:ident) => {
        stringify!($variant)
    };
    ($variant:ident $word:literal) => {
        $word
    };
}

/// Declares an enumeration written as a string.
macro_rules! string_enum {
    ($(#[doc = $doc:literal])* pub enum $name:ident { $($(#[doc = $vdoc:literal])* $variant:ident $(= $word:literal)?,)* }) => {
        $(#[doc = $doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
        pub enum $name { $($(#[doc = $vdoc])* $(#[serde(rename = $word)])? $variant,)* }

        impl $name {
            /// Every value, in the order of the specification.
            pub const ALL: &[$name] = &[$($name::$variant),*];

            /// The word as written in a document.
            pub fn as_str(self) -> &'static str {
                match self { $($name::$variant => $crate::object::word!($variant $($word)?),)* }
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.as_str())
            }
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                use serde::de::Error;
                let word = <std::borrow::Cow<'_, str>>::deserialize(deserializer)?;
                $name::ALL.iter().copied().find(|v| v.as_str() == word).ok_or_else(|| {
                    D::Error::unknown_variant(&word, &[$($crate::object::word!($variant $($word)?)),*])
                })
            }
        }

        $crate::object::schema! { $name, false, |_generator| $crate::object::string_enum_schema(
            &[$($doc),*],
            &[$(($crate::object::word!($variant $($word)?), &[$($vdoc),*] as &[&str])),*],
        ) }
    };
}

/// Declares non-negative integer types, index spaces and counts, with their annotations (SPEC 11.3).
macro_rules! integer {
    ($($(#[doc = $doc:literal])* pub struct $name:ident says $keyword:literal = $says:literal;)*) => {$(
        $(#[doc = $doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, serde::Serialize)]
        #[serde(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// The value as a position in a Rust slice.
            pub fn get(self) -> usize {
                self.0 as usize
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                self.0.fmt(f)
            }
        }

        impl From<u32> for $name {
            fn from(value: u32) -> Self {
                $name(value)
            }
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserializer.deserialize_any($crate::object::IntegerVisitor).map($name)
            }
        }

        $crate::object::schema! {
            $name, true, |_generator| $crate::object::integer_schema(&[$($doc),*], $keyword, $says)
        }
    )*};
}

/// Declares strings that must match a regular expression.
macro_rules! pattern {
    ($($(#[doc = $doc:literal])* pub struct $name:ident matches $regex:literal by $accepts:expr;)*) => {$(
        $(#[doc = $doc])*
        #[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
        #[serde(transparent)]
        pub struct $name(String);

        impl $name {
            /// The string if it matches, else `None`.
            pub fn new(text: impl Into<String>) -> Option<Self> {
                let text = text.into();
                let accepts: fn(&str) -> bool = $accepts;
                accepts(&text).then_some($name(text))
            }

            /// The string as written.
            pub fn as_str(&self) -> &str {
                &self.0
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(&self.0)
            }
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                use serde::de::Error;
                let text = String::deserialize(deserializer)?;
                $name::new(text).ok_or_else(|| D::Error::custom(concat!("expected a string matching ", $regex)))
            }
        }

        $crate::object::schema! {
            $name, true, |_generator| $crate::object::pattern_schema(&[$($doc),*], $regex)
        }
    )*};
}

/// Says the schema of a type, and whether it stands where it is used instead of being a definition of its own.
macro_rules! schema {
    ($name:ident, $is_inline:literal, |$generator:ident| $schema:expr) => {
        impl schemars::JsonSchema for $name {
            fn inline_schema() -> bool {
                $is_inline
            }

            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema($generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
                $schema
            }
        }
    };
}

pub(crate) use {integer, object, pattern, schema, string_enum, word};

/// The position in `fields` of the object's next known key. Skips extension keys; any other key is
/// an error.
pub(crate) fn next_field<'de, A: MapAccess<'de>>(
    map: &mut A,
    fields: &'static [&'static str],
    document: bool,
) -> Result<Option<usize>, A::Error> {
    loop {
        match map.next_key_seed(KeySeed { fields, document })? {
            None => return Ok(None),
            Some(Key::Field(slot)) => return Ok(Some(slot)),
            Some(Key::Schema) => {
                map.next_value::<String>()?;
            }
            Some(Key::Extension) => {
                map.next_value::<IgnoredAny>()?;
            }
        }
    }
}

enum Key {
    Field(usize),
    Schema,
    Extension,
}

struct KeySeed {
    fields: &'static [&'static str],
    document: bool,
}

impl<'de> DeserializeSeed<'de> for KeySeed {
    type Value = Key;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Key, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for KeySeed {
    type Value = Key;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E: Error>(self, key: &str) -> Result<Key, E> {
        if let Some(slot) = self.fields.iter().position(|field| *field == key) {
            Ok(Key::Field(slot))
        } else if self.document && key == "$schema" {
            Ok(Key::Schema)
        } else if key.starts_with(EXTENSION_PREFIX) {
            Ok(Key::Extension)
        } else {
            Err(E::unknown_field(key, self.fields))
        }
    }
}

/// Reads an unsigned 32-bit JSON integer. As in JSON Schema, `1.0` is an integer.
pub(crate) struct IntegerVisitor;

impl Visitor<'_> for IntegerVisitor {
    type Value = u32;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an integer from 0 to 4294967295")
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<u32, E> {
        u32::try_from(value)
            .map_err(|_| E::invalid_value(serde::de::Unexpected::Unsigned(value), &self))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<u32, E> {
        u32::try_from(value)
            .map_err(|_| E::invalid_value(serde::de::Unexpected::Signed(value), &self))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<u32, E> {
        let integer = value as u32;
        if f64::from(integer) == value {
            Ok(integer)
        } else {
            Err(E::invalid_value(serde::de::Unexpected::Float(value), &self))
        }
    }
}

/// Makes every property required and forbids all other keys except extensions.
pub(crate) fn close(schema: &mut Schema) {
    let required: Vec<Value> = schema
        .get("properties")
        .and_then(Value::as_object)
        .map(|properties| properties.keys().cloned().map(Value::from).collect())
        .unwrap_or_default();
    schema.insert("type".to_owned(), json!("object"));
    schema.insert("required".to_owned(), json!(required));
    extension_properties(schema);
}

/// Forbids all keys except named properties and extensions.
pub(crate) fn extension_properties(schema: &mut Schema) {
    schema.insert("patternProperties".to_owned(), json!({ format!("^{EXTENSION_PREFIX}"): {} }));
    schema.insert("additionalProperties".to_owned(), json!(false));
}

/// As [`close`], for a whole document: `$schema` is allowed too.
pub(crate) fn close_document(schema: &mut Schema) {
    close(schema);
    if let Some(properties) = schema.get_mut("properties").and_then(Value::as_object_mut) {
        properties.insert(
            "$schema".to_owned(),
            json!({ "type": "string", "description": "The JSON Schema that this document follows, for editors." }),
        );
    }
}

pub(crate) fn paragraph(doc: &[&str]) -> String {
    let lines: Vec<&str> = doc.iter().map(|line| line.trim()).collect();
    lines.join("\n").trim().to_owned()
}

pub(crate) fn integer_schema(doc: &[&str], keyword: &str, says: &str) -> Schema {
    object_schema(json!({
        "description": paragraph(doc), keyword: says, "type": "integer", "minimum": 0, "maximum": u32::MAX,
    }))
}

pub(crate) fn pattern_schema(doc: &[&str], regex: &str) -> Schema {
    object_schema(json!({ "description": paragraph(doc), "type": "string", "pattern": regex }))
}

pub(crate) fn string_enum_schema(doc: &[&str], variants: &[(&str, &[&str])]) -> Schema {
    let mut description = paragraph(doc);
    for (word, doc) in variants {
        description.push_str(&format!("\n- `{word}`: {}", paragraph(doc)));
    }
    let words: Vec<&str> = variants.iter().map(|(word, _)| *word).collect();
    object_schema(json!({ "description": description, "type": "string", "enum": words }))
}

pub(crate) fn object_schema(value: Value) -> Schema {
    match value {
        Value::Object(map) => map.into(),
        _ => Schema::default(),
    }
}
