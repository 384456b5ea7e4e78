//! The macros that declare the format's types, each as the source of its schema. See [`object`](super::object).

use schemars::{Schema, SchemaGenerator};
use serde_json::{Value, json};

use super::object::{extension_properties, object_schema, paragraph};

/// Declares a whole document, the first type, and types in it as [`types!`] does.
macro_rules! module {
    ($(#[$meta:meta])* pub struct $name:ident $fields:tt $($rest:tt)*) => {
        $crate::object::object! {
            true, $crate::object::close_document, $(#[$meta])* pub struct $name $fields
        }
        $crate::types::types! { $($rest)* }
    };
}

/// Declares objects, enumerations that are written as strings, and choices between kinds. A field's annotations (SPEC
/// 11.3) are behind its type: `pub radius: f64 where { unit: "m" },`.
macro_rules! types {
    () => {};
    ($(#[$meta:meta])* pub struct $name:ident $fields:tt $($rest:tt)*) => {
        $crate::object::object! {
            false, $crate::object::close, $(#[$meta])* pub struct $name $fields
        }
        $crate::types::types! { $($rest)* }
    };
    ($(#[doc = $doc:literal])* pub enum $name:ident {
        $($(#[doc = $vdoc:literal])* $variant:ident $(= $word:literal)?,)*
    } $($rest:tt)*) => {
        $crate::object::string_enum! {
            $(#[doc = $doc])* pub enum $name { $($(#[doc = $vdoc])* $variant $(= $word)?,)* }
        }
        $crate::types::types! { $($rest)* }
    };
    ($(#[doc = $doc:literal])* pub enum $name:ident $kinds:tt $($rest:tt)*) => {
        $crate::types::tagged! { $(#[doc = $doc])* pub enum $name $kinds }
        $crate::types::types! { $($rest)* }
    };
}

/// Declares a choice: an object whose one key names the kind of the value (`{"Box": {…}}`). A kind
/// without content is written as the word alone (`"World"`).
///
/// serde's derive writes the same, but also reads `{"World": null}`, and rejects extension keys
/// beside the one key.
macro_rules! tagged {
    ($(#[doc = $doc:literal])* pub enum $name:ident { $($(#[doc = $vdoc:literal])* $variant:ident $(($ty:ty))?,)* }) => {
        $(#[doc = $doc])*
        #[derive(Debug, Clone, PartialEq, serde::Serialize)]
        pub enum $name { $($(#[doc = $vdoc])* $variant $(($ty))?,)* }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                const WORDS: &[&str] = &[$(stringify!($variant)),*];
                // The slot of a kind without content is never used.
                #[allow(dead_code)]
                enum Slot { $($variant),* }
                struct ChoiceVisitor;

                impl<'de> serde::de::Visitor<'de> for ChoiceVisitor {
                    type Value = $name;

                    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(f, concat!(stringify!($name), ", one of {}"), WORDS.join(", "))
                    }

                    fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<$name, E> {
                        $($crate::types::tagged!(@word $name, word, $variant $(($ty))?);)*
                        Err(E::invalid_value(serde::de::Unexpected::Str(word), &self))
                    }

                    fn visit_map<A: serde::de::MapAccess<'de>>(self, mut map: A) -> Result<$name, A::Error> {
                        use serde::de::Error;
                        let mut found = None;
                        while let Some(slot) = $crate::object::next_field(&mut map, WORDS, false)? {
                            $($(if slot == Slot::$variant as usize {
                                if found.replace($name::$variant(map.next_value::<$ty>()?)).is_some() {
                                    return Err(A::Error::custom(concat!("more than one kind of ", stringify!($name))));
                                }
                                continue;
                            })?)*
                            return Err(A::Error::custom("this kind is written as a word, not as an object"));
                        }
                        found.ok_or_else(|| A::Error::custom(format_args!("expected one key of {}", WORDS.join(", "))))
                    }
                }
                deserializer.deserialize_any(ChoiceVisitor)
            }
        }

        $crate::object::schema! { $name, false, |generator| $crate::types::choice_schema(
            &[$($doc),*],
            vec![$($crate::types::tagged!(@kind $name, generator, &[$($vdoc),*], $variant $(($ty))?)),*],
        ) }
    };
    (@word $name:ident, $word:ident, $variant:ident) => {
        if $word == stringify!($variant) {
            return Ok($name::$variant);
        }
    };
    (@word $name:ident, $word:ident, $variant:ident ($ty:ty)) => {};
    (@kind $name:ident, $generator:ident, $doc:expr, $variant:ident) => {
        $crate::types::word_schema(stringify!($variant), $doc)
    };
    (@kind $name:ident, $generator:ident, $doc:expr, $variant:ident ($ty:ty)) => {{
        let content = $generator.subschema_for::<$ty>();
        $crate::types::kind_schema($generator, stringify!($name), stringify!($variant), $doc, content)
    }};
}

pub(crate) use {module, tagged, types};

pub(crate) fn choice_schema(doc: &[&str], kinds: Vec<Value>) -> Schema {
    object_schema(json!({ "description": paragraph(doc), "oneOf": kinds }))
}

pub(crate) fn word_schema(word: &str, doc: &[&str]) -> Value {
    json!({ "description": paragraph(doc), "type": "string", "const": word })
}

/// A reference to the schema of the one-key object. The schema is a named definition, since code
/// generators number unnamed alternatives.
pub(crate) fn kind_schema(
    generator: &mut SchemaGenerator,
    choice: &str,
    word: &str,
    doc: &[&str],
    content: Schema,
) -> Value {
    let mut schema = object_schema(json!({
        "description": paragraph(doc),
        "type": "object",
        "properties": { word: content },
        "required": [word],
    }));
    extension_properties(&mut schema);
    let name = format!("{word}{choice}");
    let reference = format!("#/$defs/{name}");
    generator.definitions_mut().insert(name, schema.to_value());
    json!({ "$ref": reference })
}
