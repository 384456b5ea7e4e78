//! A document's fault: one keyword of its schema is broken.

use serde_json::Value;

/// The keyword.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Type,
    Required,
    Unknown,
    Minimum,
    Maximum,
    Fewer,
    More,
    Pattern,
    Enum,
}

/// What is done at the pointer.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    Set(Value),
    Remove,
}

/// A fault of a document.
#[derive(Debug, Clone)]
pub struct Fault {
    pub kind: Kind,
    /// The place in the schema, beginning with its definition.
    pub place: String,
    /// The subschema, without words.
    pub schema: String,
    /// The place in the schema that refers to the definition.
    pub reference: String,
    /// Where in the document.
    pub pointer: String,
    pub change: Change,
}

impl Kind {
    const fn word(self) -> &'static str {
        match self {
            Kind::Type => "of-another-type",
            Kind::Required => "missing",
            Kind::Unknown => "with-an-unknown-key",
            Kind::Minimum => "below-the-minimum",
            Kind::Maximum => "above-the-maximum",
            Kind::Fewer => "too-short",
            Kind::More => "too-long",
            Kind::Pattern => "of-another-form",
            Kind::Enum => "that-is-no-word-of-the-list",
        }
    }
}

impl Fault {
    /// Equal for faults of the same keyword in the same place of the schema.
    pub fn key(&self) -> String {
        format!("{} {}", self.place, self.kind.word())
    }

    /// Equal for faults of which one is a case: once for each definition, also where several modules have it.
    pub fn kept_once(&self, module: &str) -> String {
        let (word, schema) = (self.kind.word(), &self.schema);
        match self.place.starts_with("/$defs") {
            true => format!("{} {schema} {word}", self.place),
            false => format!("{module}{} {word}", self.place),
        }
    }

    /// The case's name: `urdf-origin-xyz-missing`.
    pub fn name(&self, module: &str) -> String {
        let mut parts = vec![module.replace('_', "-")];
        let place = self.place.split('/').filter(|part| !part.is_empty() && *part != "$defs");
        for part in place {
            if part.bytes().all(|byte| byte.is_ascii_digit()) {
                continue;
            }
            let mut words = String::new();
            for (at, letter) in part.char_indices() {
                if letter.is_ascii_uppercase() && at > 0 {
                    words.push('-');
                }
                words.push(if letter == '_' { '-' } else { letter.to_ascii_lowercase() });
            }
            match &*words {
                "any-of" | "one-of" | "all-of" => {}
                "items" => parts.push("element".to_owned()),
                _ => parts.push(words),
            }
        }
        parts.push(self.kind.word().to_owned());
        parts.join("-")
    }
}
