//! One schema for a whole URDD of version 1, so that code generators emit one set of types instead
//! of one per file.

use serde_json::{Map, Value, json};

use super::schema::{Subject, Variant, each_schema};

/// The schema of an object with a property for `urdd.json` and one for each module. Each shared
/// definition occurs once.
pub fn bundle(variant: Variant) -> Value {
    let mut definitions = Map::new();
    let mut properties = Map::new();
    for subject in Subject::all().filter(|subject| subject.is_version_1()) {
        let name = match subject {
            Subject::RootMetadata => "urdd.json",
            subject => subject.name(),
        };
        let reference = add(subject.schema(variant), subject.name(), &mut definitions);
        properties.insert(name.to_owned(), json!({ "$ref": reference }));
    }
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": match variant {
            Variant::Strict => "urn:urdd:schema:bundle:1.0.0",
            Variant::Open => "urn:urdd:schema:bundle:1.0.0:open",
        },
        "title": "Urdd",
        "description": "The documents of a URDD of version 1 by the names of the modules: a text for code generators, \
                        not of a file that a URDD has.",
        "type": "object",
        "properties": properties,
        "$defs": definitions,
    })
}

/// Adds a schema and its definitions, and returns the reference to it.
fn add(mut schema: Value, name: &str, definitions: &mut Map<String, Value>) -> String {
    let object = schema.as_object_mut();
    let own = object.and_then(|object| {
        object.shift_remove("$schema");
        object.shift_remove("$id");
        object.shift_remove("$defs")
    });
    let title = schema["title"].as_str().unwrap_or(name).to_owned();
    let own = match own {
        Some(Value::Object(own)) => own,
        _ => Map::new(),
    };
    let clash =
        |(key, value): (&String, &Value)| definitions.get(key).is_some_and(|other| other != value);
    // On a name clash, prefix all definitions of this module.
    let prefix = if own.iter().any(clash) { title.as_str() } else { "" };
    for (key, mut value) in own {
        refer(&mut value, prefix);
        if !prefix.is_empty() {
            value["title"] = json!(format!("{prefix}{key}"));
        }
        definitions.insert(format!("{prefix}{key}"), value);
    }
    refer(&mut schema, prefix);
    let reference = format!("#/$defs/{title}");
    definitions.insert(title, schema);
    reference
}

/// Prefixes the name in every `$ref`.
fn refer(schema: &mut Value, prefix: &str) {
    let Ok(schema) = schema.try_into() else {
        return;
    };
    each_schema(schema, &|object| {
        if let Some(Value::String(reference)) = object.get_mut("$ref") {
            let name = reference.strip_prefix("#/$defs/").unwrap_or(reference);
            *reference = format!("#/$defs/{prefix}{name}");
        }
    });
}
