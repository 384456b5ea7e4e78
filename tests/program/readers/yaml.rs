//! The YAML mirror, against `serde_yaml`.

use serde_json::Value;
use urdd_directory::position::TextFaultKind as Kind;
use urdd_directory::yaml::{check_mirror, is_canonical};
use urdd_directory::{canonical, json};

use super::text::{check_faults, leaves, same};

/// Between the JSON and the YAML of an input: a byte that UTF-8 never has.
const BETWEEN: u8 = 0xFF;

/// The input is YAML, or JSON and YAML with a byte 0xFF between them.
///
/// If we find that a YAML file agrees with a JSON document, another reader reads the same document from it. If another
/// reader can read the file, it does not differ from what that reader read, unless something else is reported. Changing
/// a leaf of the JSON makes a difference.
pub fn yaml(bytes: &[u8]) {
    let Some(at) = bytes.iter().position(|byte| *byte == BETWEEN) else {
        return alone(bytes);
    };
    let yaml = &bytes[at + 1..];
    let Ok(document) = json::read(&bytes[..at]) else {
        return;
    };
    mirrors_itself(&document.value);
    let faults = check_mirror(yaml, &document.value);
    check_faults(&faults, yaml);
    if faults.is_empty() {
        let peer: Value = serde_yaml::from_slice(yaml).expect("another reader reads it");
        assert!(same(&peer, &document.value), "another reader has {peer}");
    }
}

fn alone(yaml: &[u8]) {
    let peer = serde_yaml::from_slice::<Value>(yaml);
    // Some readers take an empty file as null.
    let Ok(value @ (Value::Array(_) | Value::Object(_))) = peer else {
        check_faults(&check_mirror(yaml, &Value::Null), yaml);
        return;
    };
    let faults = check_mirror(yaml, &value);
    check_faults(&faults, yaml);
    let others = faults.totals().any(|(kind, _)| kind != Kind::YamlDiffers);
    let not_finite = has_not_finite(yaml, &value);
    assert!(faults.is_empty() || others || not_finite, "{faults}: not from {value}");
    if !faults.is_empty() {
        return;
    }
    mirrors_itself(&value);
    for (pointer, _) in leaves(&value, 4) {
        let mut changed = value.clone();
        if let Some(leaf) = changed.pointer_mut(&pointer) {
            *leaf = other_than(leaf);
        }
        let faults = check_mirror(yaml, &changed);
        assert_eq!(faults.total(Kind::YamlDiffers), 1, "{pointer}: {faults}");
        let fault = faults.iter().next().expect("one fault");
        assert_eq!(fault.pointer.as_deref(), Some(pointer.as_str()));
    }
}

/// The canonical YAML of a document is its mirror, by bytes and by events, and to another reader.
fn mirrors_itself(value: &Value) {
    let text = canonical::yaml_string(value);
    assert!(is_canonical(text.as_bytes(), value));
    let commented = format!("# by hand\n{text}");
    let faults = check_mirror(commented.as_bytes(), value);
    assert!(faults.is_empty(), "{faults}\n{text}");
    let peer: Value = serde_yaml::from_str(&text).expect("canonical YAML is YAML");
    assert!(same(&peer, value), "another reader has {peer}");
}

/// Whether there is a number that is not finite, which the other reader takes for null, or for a string if it is too
/// large.
fn has_not_finite(yaml: &[u8], value: &Value) -> bool {
    let text = String::from_utf8_lossy(yaml).to_ascii_lowercase();
    let is_too_large = |value: &Value| {
        let number = value.as_str().and_then(|text| text.parse::<f64>().ok());
        number.is_some_and(|x| !x.is_finite())
    };
    let mut leaves = leaves(value, usize::MAX / 100).into_iter();
    text.contains(".inf") || text.contains(".nan") || leaves.any(|(_, leaf)| is_too_large(leaf))
}

fn other_than(leaf: &Value) -> Value {
    match leaf {
        Value::Number(number) => match number.as_f64() {
            Some(x) if x.abs() < 1e15 => Value::from(x + 0.5),
            _ => Value::from(0.25),
        },
        Value::String(text) => Value::from(format!("{text}x")),
        Value::Bool(b) => Value::from(!b),
        _ => Value::from("null"),
    }
}
