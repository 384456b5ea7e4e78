//! A schema and a document side by side: every place where an annotation is about a value. Written for the published
//! schemas alone, apart from the validator's code.

use std::collections::BTreeSet;

use serde_json::Value;
use urdd_format::annotations::{INDEX, LENGTH, Thing, of_index, of_length};

/// A value with `x-index` or `x-length`.
#[derive(Debug)]
pub struct Place {
    /// JSON Pointer into the document.
    pub pointer: String,
    /// Path of the schema, references followed: the same for the same annotation.
    pub schema: String,
    /// The keyword.
    pub keyword: &'static str,
    /// The words of the keyword.
    pub things: Vec<Thing>,
    /// The integer, or the length.
    pub found: usize,
    /// The link that the value belongs to, if known.
    pub link: Option<usize>,
}

/// The places of a document, an outer one before what is in it.
pub fn walk(schema: &Value, document: &Value) -> Vec<Place> {
    let mut walk = Walk { root: schema, places: Vec::new() };
    walk.value(schema, "", document, "", None);
    walk.places
}

/// The paths of all annotations that [`walk`] can meet.
pub fn annotated(schema: &Value) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    all(schema, schema, "", &mut BTreeSet::new(), &mut found);
    found
}

fn target<'a>(root: &'a Value, schema: &'a Value) -> Option<(&'a str, &'a Value)> {
    let name = schema["$ref"].as_str()?.strip_prefix("#/$defs/")?;
    Some((name, &root["$defs"][name]))
}

fn all<'a>(
    root: &'a Value,
    schema: &'a Value,
    path: &str,
    seen: &mut BTreeSet<&'a str>,
    found: &mut BTreeSet<String>,
) {
    for keyword in [INDEX, LENGTH] {
        if schema.get(keyword).is_some() {
            found.insert(format!("{path} {keyword}"));
        }
    }
    if let Some((name, target)) = target(root, schema)
        && seen.insert(name)
    {
        all(root, target, name, seen, found);
    }
    for keyword in ["allOf", "anyOf", "oneOf"] {
        for schema in schema[keyword].as_array().into_iter().flatten() {
            all(root, schema, path, seen, found);
        }
    }
    if let Some(items) = schema.get("items") {
        all(root, items, &format!("{path}[]"), seen, found);
    }
    for (key, schema) in schema["properties"].as_object().into_iter().flatten() {
        all(root, schema, &format!("{path}.{key}"), seen, found);
    }
}

struct Walk<'a> {
    root: &'a Value,
    places: Vec<Place>,
}

impl<'a> Walk<'a> {
    fn value(
        &mut self,
        schema: &'a Value,
        path: &str,
        value: &Value,
        pointer: &str,
        link: Option<usize>,
    ) {
        let mut place = |keyword, things: Option<Vec<Thing>>, found| {
            self.places.push(Place {
                pointer: pointer.to_owned(),
                schema: format!("{path} {keyword}"),
                keyword,
                things: things.expect("words of SPEC 11.4"),
                found,
                link,
            });
        };
        if let (Some(text), Some(index)) = (schema[INDEX].as_str(), value.as_u64()) {
            place(INDEX, of_index(text), usize::try_from(index).expect("an index"));
        }
        if let (Some(text), Some(list)) = (schema[LENGTH].as_str(), value.as_array()) {
            place(LENGTH, of_length(text), list.len());
        }
        if let Some((name, target)) = target(self.root, schema) {
            self.value(target, name, value, pointer, link);
        }
        for keyword in ["allOf", "anyOf", "oneOf"] {
            for schema in schema[keyword].as_array().into_iter().flatten() {
                self.value(schema, path, value, pointer, link);
            }
        }
        match value {
            Value::Array(list) => {
                let Some(items) = schema.get("items") else {
                    return;
                };
                let by_link = schema[LENGTH] == "links";
                for (i, value) in list.iter().enumerate() {
                    let link = if by_link { Some(i) } else { link };
                    self.value(items, &format!("{path}[]"), value, &format!("{pointer}/{i}"), link);
                }
            }
            Value::Object(map) => {
                let own = map.get("link_idx").and_then(Value::as_u64);
                let link = own.map(|link| usize::try_from(link).expect("an index")).or(link);
                for (key, schema) in schema["properties"].as_object().into_iter().flatten() {
                    if let Some(value) = map.get(key) {
                        let pointer = format!("{pointer}/{key}");
                        self.value(schema, &format!("{path}.{key}"), value, &pointer, link);
                    }
                }
            }
            _ => {}
        }
    }
}
