//! Estimates the work of a JSON Schema before doing it.

use std::collections::HashMap;

use percent_encoding::percent_decode_str;
use serde_json::Value;

/// Maximum work of a schema, in comparisons: for any document, and per value of a large document.
const WORK: u64 = 1_000_000;
const WORK_PER_VALUE: u64 = 20;

/// So many schemas inside one another are too many.
const MAX_DEPTH: usize = 5_000;

/// Keywords whose value is a schema, for the same value or for the values inside it.
const ONE: &[(&str, bool)] = &[
    ("not", false),
    ("if", false),
    ("then", false),
    ("else", false),
    ("items", true),
    ("contains", true),
    ("additionalProperties", true),
    ("unevaluatedProperties", true),
    ("unevaluatedItems", true),
    ("propertyNames", true),
];

/// Keywords whose value is a list of schemas.
const LISTS: &[(&str, bool)] =
    &[("allOf", false), ("anyOf", false), ("oneOf", false), ("prefixItems", true)];

/// Keywords whose value is an object of schemas.
const MAPS: &[(&str, bool)] =
    &[("dependentSchemas", false), ("properties", true), ("patternProperties", true)];

/// Keywords of lists, as pointers begin. Others that apply to the values inside a value are of objects.
const OF_LISTS: [&str; 4] = ["/items", "/prefixItems", "/contains", "/unevaluatedItems"];

/// The schemas inside a schema, each with its pointer and whether it applies to the values inside the value.
pub fn schemas_in(schema: &Value) -> impl Iterator<Item = (String, &Value, bool)> {
    let object = schema.as_object();
    let one = ONE
        .iter()
        .filter_map(move |(key, inner)| Some((format!("/{key}"), object?.get(*key)?, *inner)));
    let lists = LISTS
        .iter()
        .filter_map(move |(key, inner)| Some((*key, object?.get(*key)?.as_array()?, *inner)));
    let maps = MAPS
        .iter()
        .filter_map(move |(key, inner)| Some((*key, object?.get(*key)?.as_object()?, *inner)));
    one.chain(lists.flat_map(|(key, list, inner)| {
        list.iter().enumerate().map(move |(i, schema)| (format!("/{key}/{i}"), schema, inner))
    }))
    .chain(maps.flat_map(|(key, map, inner)| {
        map.iter().map(move |(name, schema)| (format!("/{key}/{}", escaped(name)), schema, inner))
    }))
}

/// A key as a part of a JSON Pointer.
pub fn escaped(key: &str) -> String {
    key.replace('~', "~0").replace('/', "~1")
}

/// The work of checking a document, if it is within the limit. Nested choices multiply, so a page of schema can demand
/// more work than any computer can do.
pub fn affordable_work(schema: &Value, document: &Value) -> Option<u64> {
    let allowed = WORK.max(WORK_PER_VALUE.saturating_mul(count_values(document)));
    let longest_key = Value::String(longest_key(document).to_owned());
    let mut estimate = Estimate {
        root: schema,
        longest_key: &longest_key,
        anchors: anchors(schema),
        known: HashMap::new(),
        steps: 0,
        allowed,
    };
    estimate.work(schema, document, 0).filter(|work| *work <= allowed)
}

fn longest_key(value: &Value) -> &str {
    let mut longest = "";
    let mut open = vec![value];
    while let Some(value) = open.pop() {
        match value {
            Value::Array(items) => open.extend(items),
            Value::Object(map) => {
                let keys = map.keys().map(String::as_str);
                longest = keys.chain([longest]).max_by_key(|key| key.len()).unwrap_or_default();
                open.extend(map.values());
            }
            _ => {}
        }
    }
    longest
}

/// The work of matching a pattern: linear in the text. It is more per character if the pattern has counted repetitions
/// or Unicode classes, whose automata have many states.
fn pattern_work(pattern: &str, text: &str) -> u64 {
    let has_many_states = pattern.contains(['{', '\\']);
    let each = pattern.len() as u64 / 32 + if has_many_states { 16 } else { 1 };
    5 + each.saturating_mul(text.len() as u64)
}

/// The work of finding a value in a list of values.
fn search_work(values: &[Value], value: &Value) -> u64 {
    let is_composite = value.is_array() || value.is_object();
    let size = if is_composite { count_values(value) } else { 1 };
    (values.iter())
        .map(|other| match other.is_array() || other.is_object() {
            true => count_values(other).min(size),
            false => 1,
        })
        .sum()
}

fn count_values(value: &Value) -> u64 {
    match value {
        Value::Array(items) => 1 + items.iter().map(count_values).sum::<u64>(),
        Value::Object(map) => 1 + map.values().map(count_values).sum::<u64>(),
        _ => 1,
    }
}

/// The schemas inside a schema that have an anchor, each once, by its name.
pub fn anchors(schema: &Value) -> HashMap<&str, Vec<&Value>> {
    let mut anchors: HashMap<&str, Vec<&Value>> = HashMap::new();
    let mut open = vec![schema];
    while let Some(schema) = open.pop() {
        for key in ["$anchor", "$dynamicAnchor"] {
            let Some(name) = schema.get(key).and_then(Value::as_str) else { continue };
            let named = anchors.entry(name).or_default();
            if !named.last().is_some_and(|last| std::ptr::eq(*last, schema)) {
                named.push(schema);
            }
        }
        open.extend(schemas_in(schema).map(|(_, schema, _)| schema));
        open.extend(definitions(schema).map(|(_, schema)| schema));
    }
    anchors
}

/// The schemas inside a schema that say nothing by themselves, each with its pointer.
pub fn definitions(schema: &Value) -> impl Iterator<Item = (String, &Value)> {
    let of = move |key: &'static str| {
        let map = schema.get(key).and_then(Value::as_object);
        map.into_iter()
            .flatten()
            .map(move |(name, schema)| (format!("/{key}/{}", escaped(name)), schema))
    };
    let content = schema.get("contentSchema").map(|schema| ("/contentSchema".to_owned(), schema));
    of("$defs").chain(of("definitions")).chain(content)
}

/// What a reference leads to.
pub fn targets<'a>(
    root: &'a Value,
    anchors: &HashMap<&str, Vec<&'a Value>>,
    reference: &str,
) -> Vec<&'a Value> {
    let Some(fragment) = reference.strip_prefix('#') else { return Vec::new() };
    if fragment.is_empty() || fragment.starts_with('/') {
        // A name with an escape (%25) is rare. A name that is not found costs nothing here, and is expensive later,
        // so both spellings are tried.
        let decoded = || percent_decode_str(fragment).decode_utf8_lossy();
        let found = root.pointer(fragment).or_else(|| root.pointer(&decoded()));
        return found.into_iter().collect();
    }
    anchors.get(fragment).cloned().unwrap_or_default()
}

struct Estimate<'a> {
    root: &'a Value,
    /// The longest key in the document, which stands for all keys when names are checked.
    longest_key: &'a Value,
    anchors: HashMap<&'a str, Vec<&'a Value>>,
    /// Work of each schema on each value, by addresses.
    known: HashMap<(*const Value, *const Value), u64>,
    steps: u64,
    allowed: u64,
}

impl<'a> Estimate<'a> {
    /// The work of checking a value against a schema; `None` if the estimate itself takes too much work.
    fn work(&mut self, schema: &'a Value, value: &'a Value, depth: usize) -> Option<u64> {
        self.steps += 1;
        if depth + 1 >= MAX_DEPTH || self.steps > self.allowed {
            return None;
        }
        let Value::Object(keywords) = schema else { return Some(1) };
        let key = (std::ptr::from_ref(schema), std::ptr::from_ref(value));
        if let Some(work) = self.known.get(&key) {
            return Some(*work);
        }
        // The validator ignores a reference that returns to itself on the same value.
        self.known.insert(key, 1);
        let mut work = keywords.len() as u64;
        if let (Some(Value::String(pattern)), Value::String(text)) =
            (keywords.get("pattern"), value)
        {
            work = work.saturating_add(pattern_work(pattern, text));
        }
        if let Some(Value::Array(values)) = keywords.get("enum") {
            work = work.saturating_add(search_work(values, value));
        }
        if keywords.contains_key("const") || keywords.contains_key("uniqueItems") {
            work = work.saturating_add(count_values(value));
        }
        if let (Some(Value::Object(patterns)), Value::Object(map)) =
            (keywords.get("patternProperties"), value)
        {
            for (pattern, key) in patterns.keys().flat_map(|p| map.keys().map(move |k| (p, k))) {
                // Once for its own schema, once for `additionalProperties`.
                work = work.saturating_add(2 * pattern_work(pattern, key));
            }
        }
        for key in ["$ref", "$dynamicRef"] {
            if let Some(Value::String(target)) = keywords.get(key) {
                for target in targets(self.root, &self.anchors, target) {
                    work = work.saturating_add(self.work(target, value, depth + 1)?);
                }
            }
        }
        let properties = keywords.get("properties").and_then(Value::as_object);
        for (pointer, inner, of_values) in schemas_in(schema) {
            if !of_values {
                work = work.saturating_add(self.work(inner, value, depth + 1)?);
                continue;
            }
            // Each schema of `properties` applies to one value; others may apply to all of them.
            if pointer.starts_with("/properties/") {
                continue;
            }
            if pointer == "/propertyNames" {
                if let Value::Object(map) = value {
                    let one = self.work(inner, self.longest_key, depth + 1)?;
                    work = work.saturating_add(one.saturating_mul(map.len() as u64));
                }
                continue;
            }
            let is_of_lists = OF_LISTS.iter().any(|keyword| pointer.starts_with(keyword));
            let values: Box<dyn Iterator<Item = &'a Value>> = match value {
                Value::Array(items) if is_of_lists => Box::new(items.iter()),
                Value::Object(map) if !is_of_lists => Box::new(map.values()),
                _ => Box::new(std::iter::empty()),
            };
            for value in values {
                work = work.saturating_add(self.work(inner, value, depth + 1)?);
            }
        }
        if let (Some(properties), Value::Object(map)) = (properties, value) {
            for (name, inner) in properties {
                if let Some(value) = map.get(name) {
                    work = work.saturating_add(self.work(inner, value, depth + 1)?);
                }
            }
        }
        self.known.insert(key, work);
        Some(work)
    }
}
