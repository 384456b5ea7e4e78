//! The field tables, Annex A of SPEC.md, generated from the published schemas, so that the two cannot differ.

use std::collections::BTreeSet;
use std::fmt::Write;

use serde_json::Value;
use urdd_format::annotations;
use urdd_format::registry::Profile;
use urdd_format::schema::{Subject, Variant};

/// The tables of the root metadata and of every module of version 1.
pub fn tables() -> String {
    let mut text = String::new();
    let mut told = BTreeSet::new();
    for subject in Subject::all() {
        match subject {
            Subject::Module(spec) if spec.profile != Profile::V1 => continue,
            Subject::Report
            | Subject::EarlierReport(1..)
            | Subject::DiffReport
            | Subject::EarlierDiffReport(_)
            | Subject::ProducerResult
            | Subject::ValidatorResult
            | Subject::EarlierValidatorResult(_) => continue,
            _ => {}
        }
        let schema = subject.schema(Variant::Strict);
        let title = if subject.name() == "root_metadata" { "urdd.json" } else { subject.name() };
        let _ = writeln!(text, "## `{title}` {}\n", subject.version());
        object(&schema, &schema, &mut text);
        for (name, definition) in definitions(&schema) {
            // What several modules share appears with the first.
            if is_kind(name, &schema) {
                continue;
            }
            if definition.get("properties").is_some() && told.insert(name.clone()) {
                let _ = writeln!(text, "**{name}.** {}\n", description(definition));
                object(definition, &schema, &mut text);
            } else if let Some(kinds) = definition.get("oneOf").and_then(Value::as_array)
                && told.insert(name.clone())
            {
                let _ = writeln!(text, "**{name}.** {} One of:\n", description(definition));
                for kind in kinds {
                    let kind = resolve(kind, &schema);
                    for (key, value) in properties(kind) {
                        let _ = writeln!(text, "- `{{\"{key}\": {}}}`", type_of(value, &schema));
                    }
                }
                text.push('\n');
            }
        }
    }
    text
}

fn definitions(schema: &Value) -> impl Iterator<Item = (&String, &Value)> {
    schema.get("$defs").and_then(Value::as_object).into_iter().flatten()
}

fn properties(schema: &Value) -> impl Iterator<Item = (&String, &Value)> {
    let properties = schema.get("properties").and_then(Value::as_object);
    properties.into_iter().flatten().filter(|(key, _)| *key != "$schema")
}

fn object(schema: &Value, root: &Value, text: &mut String) {
    text.push_str("| key | type | meaning |\n|---|---|---|\n");
    for (key, value) in properties(schema) {
        let mut meaning = description(value);
        let says = annotations::sentence(value);
        if !says.is_empty() {
            let _ = write!(meaning, " {says}");
        }
        let _ = writeln!(text, "| `{key}` | {} | {meaning} |", type_of(value, root));
    }
    text.push('\n');
}

fn description(schema: &Value) -> String {
    let text = schema.get("description").and_then(Value::as_str).unwrap_or_default();
    // The values of an enumeration follow as a list, which `type_of` describes.
    let text = text.split("\n- ").next().unwrap_or_default();
    text.replace('\n', " ").replace('|', "\\|")
}

fn resolve<'a>(schema: &'a Value, root: &'a Value) -> &'a Value {
    let reference = schema.get("$ref").or_else(|| schema.pointer("/allOf/0/$ref"));
    let pointer =
        reference.and_then(Value::as_str).and_then(|reference| reference.strip_prefix('#'));
    pointer.and_then(|pointer| root.pointer(pointer)).unwrap_or(schema)
}

/// The type of a value, in words.
fn type_of(schema: &Value, root: &Value) -> String {
    if let Some(choices) = schema.get("anyOf").and_then(Value::as_array) {
        let words: Vec<String> = choices.iter().map(|choice| type_of(choice, root)).collect();
        return words.join(" or ");
    }
    let target = resolve(schema, root);
    if let Some(words) = target.get("enum").and_then(Value::as_array) {
        let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
        return words.join(", ");
    }
    if !std::ptr::eq(target, schema) {
        let title = target.get("title").and_then(Value::as_str).unwrap_or("object");
        return title.to_owned();
    }
    match schema.get("type") {
        Some(Value::Array(types)) => {
            let words = types.iter().filter_map(Value::as_str);
            let words: Vec<String> = words.map(|word| word_for(word, schema, root)).collect();
            words.join(" or ")
        }
        Some(Value::String(word)) => word_for(word, schema, root),
        _ => "any".to_owned(),
    }
}

fn word_for(word: &str, schema: &Value, root: &Value) -> String {
    if word != "array" {
        return word.to_owned();
    }
    if let Some(items) = schema.get("prefixItems").and_then(Value::as_array) {
        let items: Vec<String> = items.iter().map(|item| type_of(item, root)).collect();
        return format!("list of {}", items.join(", then "));
    }
    let items = schema.get("items").map(|items| type_of(items, root)).unwrap_or_default();
    let (least, most) = (schema.get("minItems"), schema.get("maxItems"));
    match least {
        Some(length) if least == most => format!("{length} of {items}"),
        _ => format!("list of ({items})"),
    }
}

/// Whether a definition is one alternative of a choice, described with the choice.
fn is_kind(name: &str, root: &Value) -> bool {
    let reference = format!("#/$defs/{name}");
    definitions(root).any(|(_, definition)| {
        let kinds = definition.get("oneOf").and_then(Value::as_array);
        kinds.into_iter().flatten().any(|kind| kind["$ref"] == *reference)
    })
}
