//! A document's fault: one keyword of its schema is broken.

use serde_json::Value;

/// Whether there is a case for every place of the schemas.
const EVERY_PLACE: bool = false;

/// The keyword.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Type,
    Required { may_be_null: bool, is_first: bool },
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
            Kind::Required { .. } => "missing",
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

    /// Whether it is among the cases. All would be more than twice as many. Of keys that must be there, those count that
    /// may be null, which programs take for the same as missing, and one more of each object.
    pub const fn is_case(&self) -> bool {
        match self.kind {
            Kind::Required { may_be_null, is_first } => EVERY_PLACE || may_be_null || is_first,
            _ => true,
        }
    }

    /// Equal for faults of which one is a case: a type once for each form of value that is not an object, a bound once for
    /// each form in a module, all others once for each definition, also where several modules have it.
    pub fn kept_once(&self, module: &str) -> String {
        let (word, schema) = (self.kind.word(), &self.schema);
        let is_object = schema.contains("\"properties\"");
        match self.kind {
            Kind::Type if !EVERY_PLACE && !is_object => format!("{schema} {word}"),
            Kind::Minimum | Kind::Maximum | Kind::Fewer | Kind::More if !EVERY_PLACE => {
                format!("{module} {schema} {word}")
            }
            _ if self.place.starts_with("/$defs") => format!("{} {schema} {word}", self.place),
            _ => format!("{module}{} {word}", self.place),
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
