//! Checks a document against its schema.
//!
//! serde accepts exactly what the schema accepts (a property test verifies this), so serde reads valid documents,
//! quickly. Only invalid ones go to the schema validator, which reports every violation with its position.

use std::error::Error;

use jsonschema::error::{TypeKind, ValidationErrorKind};
use jsonschema::paths::Location;
use jsonschema::{JsonType, ValidationError};
use schemars::Schema;
use serde_json::Value;

use crate::legacy;
use urdd_directory::json_scan;
use urdd_format::registry::{ModuleDocument, ModuleSpec};
use urdd_format::short::cut;

/// Maximum length of a value in a message, in characters.
const LONGEST: usize = 80;

/// A schema violation.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SchemaViolation {
    /// JSON Pointer of the value.
    pub pointer: String,
    /// What is wrong.
    pub message: String,
    /// The expected content.
    pub expected: Option<String>,
    /// The actual content.
    pub actual: Option<String>,
    /// The unknown keys, if that is the fault.
    unknown_keys: Vec<String>,
}

impl SchemaViolation {
    /// JSON Pointer to the fault itself: to the unknown key rather than its object.
    pub fn place(&self) -> String {
        let mut pointer = self.pointer.clone();
        if let Some(key) = self.unknown_keys.first() {
            json_scan::push_segment(&mut pointer, key);
        }
        pointer
    }
}

/// Reads a document of a module, or returns its schema violations. With `newer`, ignores unknown keys: the document is
/// of a later minor version.
pub fn read(
    spec: &ModuleSpec,
    document: &Value,
    newer: bool,
) -> (Option<ModuleDocument>, Vec<SchemaViolation>) {
    let error = match legacy::read(spec, document) {
        Ok(document) => return (Some(document), Vec::new()),
        Err(error) => error,
    };
    read_newer(&spec.schema(), document, newer, &error, |known| spec.read(known).ok())
}

/// Handles a document that serde rejected with `refusal`. If it is of a later minor version (`newer`) and its only
/// violations are unknown keys, reads it without them. Otherwise returns the violations (with `newer`, except unknown
/// keys).
pub fn read_newer<T>(
    schema: &Schema,
    document: &Value,
    newer: bool,
    refusal: &dyn Error,
    read: impl FnOnce(&Value) -> Option<T>,
) -> (Option<T>, Vec<SchemaViolation>) {
    let found = violations(schema, document, refusal);
    if !newer {
        return (None, found);
    }
    let (unknown, others): (Vec<_>, Vec<_>) =
        found.into_iter().partition(|v| !v.unknown_keys.is_empty());
    if !others.is_empty() {
        return (None, others);
    }
    let mut known = document.clone();
    for violation in &unknown {
        let object = known.pointer_mut(&violation.pointer).and_then(Value::as_object_mut);
        if let Some(object) = object {
            object.retain(|key, _| !violation.unknown_keys.contains(key));
        }
    }
    (read(&known), Vec::new())
}

/// Every schema violation of a document. If the schema reports none, returns `refusal`, serde's error, so that an
/// unreadable document never passes.
pub fn violations(schema: &Schema, document: &Value, refusal: &dyn Error) -> Vec<SchemaViolation> {
    let whole = |message: String| SchemaViolation { message, ..SchemaViolation::default() };
    let mut found = Vec::new();
    match jsonschema::draft202012::new(schema.as_value()) {
        Ok(validator) => {
            for error in validator.iter_errors(document) {
                describe(&error, &mut found);
            }
        }
        Err(error) => found.push(whole(format!("the schema cannot be used: {error}"))),
    }
    if found.is_empty() {
        found.push(whole(format!("the document cannot be read: {refusal}")));
    }
    found
}

fn describe(error: &ValidationError<'_>, found: &mut Vec<SchemaViolation>) {
    use ValidationErrorKind as Kind;
    let instance = error.instance().as_ref();
    // A choice only reports that no alternative matches. Report why the nearest one does not.
    if let Kind::AnyOf { context } | Kind::OneOfNotValid { context } = error.kind()
        && let Some(nearest) = nearest_alternative(error.instance_path(), context)
    {
        for inner in nearest {
            describe(inner, found);
        }
        return;
    }
    let actual = || Some(excerpt(instance));
    let elements = || instance.as_array().map(|list| format!("{} elements", list.len()));
    let mut unknown_keys = Vec::new();
    let (message, expected, actual) = match error.kind() {
        Kind::Required { property } => {
            let key = property.as_str().unwrap_or_default();
            let message = format!(
                "the key `{key}` is missing; every key is required: where the schema allows null, that is an absent value"
            );
            (message, Some(format!("key {key}")), None)
        }
        Kind::AdditionalProperties { unexpected } => {
            unknown_keys.clone_from(unexpected);
            let message = format!(
                "unknown {}: {}; keys of your own begin with `x_`",
                if unexpected.len() == 1 { "key" } else { "keys" },
                unexpected.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", "),
            );
            (message, None, None)
        }
        Kind::Type { kind } => {
            let expected = match kind {
                TypeKind::Single(kind) => kind.to_string(),
                TypeKind::Multiple(kinds) => {
                    kinds.iter().map(|k| k.to_string()).collect::<Vec<_>>().join(" or ")
                }
            };
            let message = format!("the value has the wrong type: expected {expected}");
            (message, Some(expected), actual())
        }
        Kind::Enum { options } => (
            "the word is not one of the defined ones".to_owned(),
            Some(format!("one of {}", excerpt(options))),
            actual(),
        ),
        Kind::MinItems { limit } => {
            let expected = format!("at least {limit} elements");
            ("the list has the wrong length".to_owned(), Some(expected), elements())
        }
        Kind::MaxItems { limit } => {
            let expected = format!("at most {limit} elements");
            ("the list has the wrong length".to_owned(), Some(expected), elements())
        }
        Kind::Minimum { limit } => {
            ("the number is too small".to_owned(), Some(format!("at least {limit}")), actual())
        }
        Kind::Maximum { limit } => {
            ("the number is too large".to_owned(), Some(format!("at most {limit}")), actual())
        }
        Kind::Pattern { pattern } => (
            "the text does not have the required form".to_owned(),
            Some(format!("text matching {pattern}")),
            actual(),
        ),
        _ => {
            let masked = error.masked().to_string();
            let masked = cut(&masked, LONGEST);
            (format!("the value does not match the schema: {masked}"), None, actual())
        }
    };
    let pointer = error.instance_path().to_string();
    found.push(SchemaViolation { pointer, message, expected, actual, unknown_keys });
}

/// The alternative of a choice at `path` that the instance means: the other one of a nullable value, or the one-key
/// object whose key the instance has.
fn nearest_alternative<'a>(
    path: &Location,
    context: &'a [Vec<ValidationError<'static>>],
) -> Option<&'a Vec<ValidationError<'static>>> {
    let is_null = |errors: &&Vec<ValidationError<'static>>| {
        errors.iter().any(|error| {
            matches!(
                error.kind(),
                ValidationErrorKind::Type { kind: TypeKind::Single(JsonType::Null) }
            )
        })
    };
    let other_key = |errors: &&Vec<ValidationError<'static>>| {
        errors.iter().any(|error| {
            error.instance_path() == path
                && matches!(error.kind(), ValidationErrorKind::Required { .. })
        })
    };
    if context.len() == 2 && context.iter().any(|errors| is_null(&errors)) {
        return context.iter().find(|errors| !is_null(errors));
    }
    context.iter().find(|errors| !errors.is_empty() && !other_key(errors))
}

/// A value as text, shortened to fit a line.
pub fn excerpt(value: &Value) -> String {
    cut(&value.to_string(), LONGEST).into_owned()
}
