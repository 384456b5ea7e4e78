//! Changes to a document, some of which keep it valid.

use serde_json::{Map, Value, json};

use testkit::documents::{Choices, arbitrary_json};

/// Words of enumerations and choices, to be used where they do not belong.
const WORDS: [&str; 10] = [
    "Mesh",
    "Cylinder",
    "Capsule",
    "World",
    "Link",
    "Urdf",
    "AddSingleLinkFromStlFile",
    "AddSingleLinkFromObjFile",
    "Fixed",
    "fixed",
];

/// Makes one change somewhere.
pub fn mutate(document: &mut Value, choices: &mut Choices) {
    if choices.pick(6) == 0 {
        return mutate_top(document, choices);
    }
    let mut pointers = Vec::new();
    collect(document, String::new(), &mut pointers);
    // Most of a document is numbers; most of what can go wrong is in the rest.
    if choices.pick(2) == 0 {
        pointers.retain(|pointer| {
            pointer.is_empty() || !document.pointer(pointer).is_some_and(Value::is_number)
        });
    }
    let pointer = choices.one(&pointers);
    if let Some(node) = document.pointer_mut(&pointer) {
        mutate_node(node, choices);
    }
}

/// Adds a key to every object.
pub fn add_key_everywhere(value: &mut Value, key: &str) {
    match value {
        Value::Object(object) => {
            object.values_mut().for_each(|v| add_key_everywhere(v, key));
            object.insert(key.to_owned(), json!([1]));
        }
        Value::Array(items) => items.iter_mut().for_each(|v| add_key_everywhere(v, key)),
        _ => {}
    }
}

fn collect(value: &Value, pointer: String, pointers: &mut Vec<String>) {
    match value {
        Value::Object(object) => {
            for (key, value) in object {
                let key = key.replace('~', "~0").replace('/', "~1");
                collect(value, format!("{pointer}/{key}"), pointers);
            }
        }
        Value::Array(items) => {
            for (i, value) in items.iter().enumerate() {
                collect(value, format!("{pointer}/{i}"), pointers);
            }
        }
        _ => {}
    }
    pointers.push(pointer);
}

fn mutate_top(document: &mut Value, choices: &mut Choices) {
    let Value::Object(object) = document else {
        return;
    };
    let schema = match choices.pick(3) {
        0 => json!("https://example.org/schema.json"),
        1 => json!(null),
        _ => arbitrary_json(choices, 1),
    };
    object.insert("$schema".to_owned(), schema);
}

fn mutate_node(node: &mut Value, choices: &mut Choices) {
    if choices.pick(8) == 0 {
        *node = anything(choices);
        return;
    }
    match node {
        Value::Object(object) => {
            if let Some(replacement) = mutate_object(object, choices) {
                *node = replacement;
            }
        }
        Value::Array(items) => mutate_array(items, choices),
        Value::Number(_) => *node = number(choices),
        Value::String(word) => {
            *node = match choices.pick(6) {
                0 => json!({ word.as_str(): null }),
                1 => json!({ word.as_str(): {} }),
                2 => json!(word.to_lowercase()),
                3 => json!(format!("{word} ")),
                4 => json!([word]),
                _ => json!(choices.one(&WORDS)),
            }
        }
        Value::Bool(_) | Value::Null => *node = anything(choices),
    }
}

fn anything(choices: &mut Choices) -> Value {
    match choices.pick(4) {
        0 => Value::Null,
        1 => number(choices),
        2 => json!(choices.one(&WORDS)),
        _ => arbitrary_json(choices, 2),
    }
}

fn number(choices: &mut Choices) -> Value {
    choices.one(&[
        json!(1),
        json!(1.0),
        json!(1.5),
        json!(-1),
        json!(-0.0),
        json!(4_294_967_295_u64),
        json!(4_294_967_296_u64),
        json!(4_294_967_295.0),
        json!(4_294_967_296.0),
        json!(u64::MAX),
        json!(i64::MIN),
        json!(1e300),
        json!(-1e300),
        json!(5e-324),
        json!("1"),
    ])
}

/// Changes an object, or returns its replacement.
fn mutate_object(object: &mut Map<String, Value>, choices: &mut Choices) -> Option<Value> {
    let keys: Vec<String> = object.keys().cloned().collect();
    let key = if keys.is_empty() { String::new() } else { choices.one(&keys) };
    match choices.pick(10) {
        0 => {
            object.shift_remove(&key);
        }
        1 => {
            object.insert("x_vendor".to_owned(), arbitrary_json(choices, 1));
        }
        2 => {
            let stranger = choices.one(&["extra", "$schema", "X_vendor", "x-vendor", "", "$id"]);
            object.insert(stranger.to_owned(), json!("text"));
        }
        3 => {
            // A second alternative of a choice, next to the first.
            let value = object.get(&key).cloned().unwrap_or_default();
            object.insert(choices.one(&WORDS).to_owned(), value);
        }
        4 => {
            let value = object.shift_remove(&key).unwrap_or_default();
            object.insert(key.to_uppercase(), value);
        }
        5 => return Some(object.values().cloned().collect()),
        6 => return Some(json!(key)),
        7 => {
            // The order of keys means nothing.
            let value = object.shift_remove(&key)?;
            object.insert(key, value);
        }
        8 => {
            object.insert("x_".to_owned(), json!({ "a": [null] }));
        }
        _ => {
            object.insert(key, anything(choices));
        }
    }
    None
}

fn mutate_array(items: &mut Vec<Value>, choices: &mut Choices) {
    match choices.pick(4) {
        0 => {
            items.pop();
        }
        1 => items.push(items.last().cloned().unwrap_or_default()),
        2 => items.push(anything(choices)),
        _ => items.reverse(),
    }
}
