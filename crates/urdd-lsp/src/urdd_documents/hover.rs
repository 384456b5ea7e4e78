//! What a value of a document means, by its schema.

use lsp_types::{Hover, Position};
use serde_json::Value;

use crate::document::Snapshot;
use crate::kind::Schema;
use crate::shown::markdown;
use urdd_directory::json_scan::pointer_at;
use urdd_directory::yaml::places;
use urdd_format::annotations;
use urdd_format::schema::Variant;

/// How many references to other parts of the schema are followed.
const MOST_REFERENCES: usize = 20;

/// What the value at a position means.
pub fn hover(snapshot: &Snapshot, schema: Schema, is_yaml: bool, at: Position) -> Option<Hover> {
    if snapshot.is_too_large() {
        return None;
    }
    let text = snapshot.text.as_str();
    let offset = snapshot.text.offset(at);
    let pointer = match is_yaml {
        true => places::read(text)?.pointer_at(offset)?.to_owned(),
        // The token at the cursor counts, also at its start.
        false => pointer_at(text, (offset + 1).min(text.len())),
    };
    let whole = schema.subject.schema(Variant::Strict);
    let words = words(&whole, &pointer)?;
    let shown = match pointer.as_str() {
        "" => schema.subject.id(),
        pointer => pointer.to_owned(),
    };
    Some(markdown(format!("**`{shown}`**\n\n{words}"), None))
}

/// The description of the value at a pointer, with its unit, frame and length.
fn words(whole: &Value, pointer: &str) -> Option<String> {
    let mut parts = vec![whole];
    for segment in pointer.split('/').skip(1) {
        let key = segment.replace("~1", "/").replace("~0", "~");
        let inner = parts.iter().flat_map(|part| meant(whole, part));
        parts = inner.filter_map(|part| inside(part, &key)).collect();
    }
    let all: Vec<&Value> = parts.iter().flat_map(|part| meant(whole, part)).collect();
    let mut words: Vec<String> = Vec::new();
    for part in all {
        let description = part["description"].as_str().unwrap_or_default().to_owned();
        for text in [description, annotations::sentence(part), values(part)] {
            if !text.is_empty() && !words.contains(&text) {
                words.push(text);
            }
        }
    }
    (!words.is_empty()).then(|| words.join("\n\n"))
}

/// The schema of an element or member.
fn inside<'s>(schema: &'s Value, key: &str) -> Option<&'s Value> {
    if let Some(member) = schema.get("properties").and_then(|all| all.get(key)) {
        return Some(member);
    }
    if let Ok(index) = key.parse::<usize>() {
        let tuple = schema.get("prefixItems").and_then(|all| all.get(index));
        if let Some(element) = tuple.or_else(|| schema.get("items")) {
            return Some(element);
        }
    }
    schema.get("additionalProperties").filter(|other| other.is_object())
}

/// A schema, and those that it refers to or is a choice of.
fn meant<'s>(whole: &'s Value, schema: &'s Value) -> Vec<&'s Value> {
    let mut found = vec![schema];
    let mut next = 0;
    while let Some(one) = found.get(next).copied().filter(|_| found.len() < MOST_REFERENCES) {
        next += 1;
        let reference = one["$ref"].as_str().and_then(|reference| reference.strip_prefix('#'));
        found.extend(reference.and_then(|pointer| whole.pointer(pointer)));
        for choice in ["allOf", "anyOf", "oneOf"] {
            found.extend(one[choice].as_array().into_iter().flatten());
        }
    }
    found
}

/// The words that a value may be.
fn values(schema: &Value) -> String {
    if let Some(value) = schema.get("const") {
        return format!("`{value}`");
    }
    let words = schema["enum"].as_array().into_iter().flatten();
    let values: Vec<String> = words.map(|value| format!("`{value}`")).collect();
    if values.is_empty() { String::new() } else { format!("One of {}.", values.join(", ")) }
}
