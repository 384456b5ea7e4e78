//! Walks a document and its schema together.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use super::faults::{Change, Fault, Kind};

/// Where a walk is.
#[derive(Clone)]
struct At {
    place: String,
    reference: String,
    pointer: String,
}

impl At {
    fn inside(&self, place: &str, pointer: &str) -> At {
        At {
            place: format!("{}/{place}", self.place),
            reference: self.reference.clone(),
            pointer: format!("{}{pointer}", self.pointer),
        }
    }
}

struct Walk<'a> {
    root: &'a Value,
    faults: Vec<Fault>,
    places: BTreeSet<String>,
    objects: BTreeSet<String>,
}

fn walk<'a>(schema: &'a Value, document: &Value) -> Walk<'a> {
    let mut walk = Walk {
        root: schema,
        faults: Vec::new(),
        places: BTreeSet::new(),
        objects: BTreeSet::new(),
    };
    let start = At { place: String::new(), reference: String::new(), pointer: String::new() };
    walk.visit(schema, document, &start, true);
    walk
}

/// Every fault that this document can get.
pub fn faults(schema: &Value, document: &Value) -> Vec<Fault> {
    walk(schema, document).faults
}

/// Pointers to every object that a schema describes.
pub fn objects(schema: &Value, document: &Value) -> BTreeSet<String> {
    walk(schema, document).objects
}

/// The places of a schema that describe something in a document.
pub fn places(schema: &Value, document: &Value) -> BTreeSet<String> {
    walk(schema, document).places
}

/// Every place of a schema, but those of `null` and `$schema`.
pub fn all_places(root: &Value) -> BTreeSet<String> {
    let mut places = BTreeSet::new();
    let mut waiting = vec![(root, String::new())];
    let defined = root["$defs"].as_object().into_iter().flatten();
    waiting.extend(defined.map(|(name, schema)| (schema, format!("/$defs/{name}"))));
    while let Some((schema, place)) = waiting.pop() {
        if schema["type"] == "null" || schema.get("$ref").is_some() {
            continue;
        }
        let properties = schema["properties"].as_object().into_iter().flatten();
        let properties = properties.filter(|(name, _)| *name != "$schema");
        waiting.extend(properties.map(|(name, inner)| (inner, format!("{place}/{name}"))));
        for key in ["anyOf", "oneOf", "allOf"] {
            let list = schema[key].as_array().into_iter().flatten().enumerate();
            waiting.extend(list.map(|(at, inner)| (inner, format!("{place}/{key}/{at}"))));
        }
        if let Some(inner) = schema.get("items") {
            waiting.push((inner, format!("{place}/items")));
        }
        places.insert(place);
    }
    places
}

impl Walk<'_> {
    /// `is_typed`: whether another alternative is not yet broken by a value of another type.
    fn visit(&mut self, schema: &Value, value: &Value, at: &At, is_typed: bool) {
        if let Some(name) = schema["$ref"].as_str() {
            let place = name.trim_start_matches('#').to_owned();
            let target = self.root.pointer(&place).expect("a definition");
            return self.visit(
                target,
                value,
                &At { reference: at.place.clone(), place, ..at.clone() },
                is_typed,
            );
        }
        if is_typed {
            self.of_another_type(schema, at);
        }
        if !fits(schema, value) {
            return;
        }
        self.places.insert(at.place.clone());
        self.values(schema, value, at);
        for key in ["allOf", "anyOf", "oneOf"] {
            for (number, inner) in schema[key].as_array().into_iter().flatten().enumerate() {
                if inner["type"] == "null" {
                    continue;
                }
                let place = format!("{key}/{number}");
                self.visit(inner, value, &at.inside(&place, ""), number == 0);
            }
        }
        match value {
            Value::Object(map) => self.object(schema, map, at),
            Value::Array(list) => self.list(schema, list, at),
            _ => {}
        }
    }

    fn fault(&mut self, kind: Kind, schema: &Value, at: &At, pointer: &str, change: Change) {
        self.faults.push(Fault {
            kind,
            place: at.place.clone(),
            schema: without_words(schema).to_string(),
            reference: at.reference.clone(),
            pointer: format!("{}{pointer}", at.pointer),
            change,
        });
    }

    fn of_another_type(&mut self, schema: &Value, at: &At) {
        let types: Vec<&str> = types(schema);
        let other = match types.first() {
            None => return,
            _ if types.contains(&"integer") => json!(0.5),
            _ if types.contains(&"number") => json!("0"),
            Some(&"array") => json!({}),
            Some(&"object") => json!([]),
            Some(_) => json!(0),
        };
        self.fault(Kind::Type, schema, at, "", Change::Set(other));
    }

    fn values(&mut self, schema: &Value, value: &Value, at: &At) {
        if let (Some(least), true) = (schema["minimum"].as_i64(), value.is_number()) {
            self.fault(Kind::Minimum, schema, at, "", Change::Set(json!(least - 1)));
        }
        if let (Some(most), true) = (schema["maximum"].as_i64(), value.is_number()) {
            self.fault(Kind::Maximum, schema, at, "", Change::Set(json!(most + 1)));
        }
        if let (Some(_), Some(text)) = (schema["pattern"].as_str(), value.as_str()) {
            // The last letter is missing: of a hash, or of a version with its dot.
            let kept = text.trim_end_matches(|letter: char| letter.is_ascii_digit());
            let shorter = match text.len() {
                64 => &text[..63],
                _ => kept.trim_end_matches('.'),
            };
            let shorter = if shorter == text { "" } else { shorter };
            self.fault(Kind::Pattern, schema, at, "", Change::Set(json!(shorter)));
        }
        if let (Some(_), Some(word)) = (schema.get("enum"), value.as_str()) {
            let other = word.to_lowercase();
            self.fault(Kind::Enum, schema, at, "", Change::Set(json!(other)));
        }
    }

    fn object(&mut self, schema: &Value, map: &serde_json::Map<String, Value>, at: &At) {
        let Some(properties) = schema["properties"].as_object() else { return };
        self.objects.insert(at.pointer.clone());
        if schema["additionalProperties"] == false {
            let change = Change::Set(json!(1));
            self.fault(Kind::Unknown, schema, at, "/unknown", change);
        }
        for name in schema["required"].as_array().into_iter().flatten() {
            let name = name.as_str().expect("a name");
            let place = at.inside(name, "");
            self.fault(Kind::Required, schema, &place, &format!("/{name}"), Change::Remove);
        }
        for (name, inner) in properties {
            if let (Some(value), true) = (map.get(name), name != "$schema") {
                self.visit(inner, value, &at.inside(name, &format!("/{name}")), true);
            }
        }
    }

    fn list(&mut self, schema: &Value, list: &[Value], at: &At) {
        if schema.get("minItems").is_some() {
            let fewer = list.split_last().map_or(&[][..], |(_, rest)| rest);
            self.fault(Kind::Fewer, schema, at, "", Change::Set(json!(fewer)));
        }
        if let (Some(_), Some(last)) = (schema.get("maxItems"), list.last()) {
            let more = [list, std::slice::from_ref(last)].concat();
            self.fault(Kind::More, schema, at, "", Change::Set(json!(more)));
        }
        let Some(items) = schema.get("items") else { return };
        for (number, value) in list.iter().enumerate() {
            self.visit(items, value, &at.inside("items", &format!("/{number}")), true);
        }
        if list.is_empty() && items.get("type").is_some_and(|kind| kind == "string") {
            // An element that it could have.
            self.visit(items, &json!(""), &at.inside("items", "/0"), true);
        }
    }
}

/// The types that a schema names.
fn types(schema: &Value) -> Vec<&str> {
    match &schema["type"] {
        Value::String(name) => vec![name],
        Value::Array(names) => names.iter().filter_map(Value::as_str).collect(),
        _ => Vec::new(),
    }
}

/// Whether a value has a type of a schema, and the keys that tell alternatives apart.
fn fits(schema: &Value, value: &Value) -> bool {
    let name = match value {
        Value::Null => "null",
        Value::Bool(_) => "boolean",
        Value::Number(_) => "number",
        Value::String(_) => "string",
        Value::Array(_) => "array",
        Value::Object(_) => "object",
    };
    let types = types(schema);
    let is_typed = types.is_empty()
        || types.iter().any(|one| *one == name || (*one == "integer" && name == "number"));
    let required = schema["required"].as_array().into_iter().flatten();
    let has = |key: &Value| value.get(key.as_str().unwrap_or_default()).is_some();
    is_typed && (!value.is_object() || required.into_iter().all(has))
}

/// A schema without what does not decide.
fn without_words(schema: &Value) -> Value {
    const WORDS: [&str; 5] = ["description", "title", "x-unit", "x-index", "x-length"];
    match schema {
        Value::Object(map) => {
            let kept = map
                .iter()
                .filter(|(key, value)| !WORDS.contains(&key.as_str()) || value.is_object());
            kept.map(|(key, value)| (key.clone(), without_words(value))).collect()
        }
        Value::Array(list) => list.iter().map(without_words).collect(),
        other => other.clone(),
    }
}
