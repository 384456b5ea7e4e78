//! Readable JSON Patches: if a list gains or loses an element, only that element is patched.

use json_patch::Patch;
use serde_json::{Value, json};

/// The patch from `old` to `new`.
pub fn patch(old: &Value, new: &Value) -> Patch {
    let mut operations = Vec::new();
    compare(old, new, "", &mut operations);
    serde_json::from_value(Value::Array(operations)).expect("RFC 6902 operations")
}

fn compare(old: &Value, new: &Value, at: &str, out: &mut Vec<Value>) {
    match (old, new) {
        _ if old == new => {}
        (Value::Object(old), Value::Object(new)) => {
            let place = |key: &str| format!("{at}/{}", key.replace('~', "~0").replace('/', "~1"));
            for (key, value) in new {
                match old.get(key) {
                    Some(before) => compare(before, value, &place(key), out),
                    None => out.push(json!({"op": "add", "path": place(key), "value": value})),
                }
            }
            for key in old.keys().filter(|key| !new.contains_key(*key)) {
                out.push(json!({"op": "remove", "path": place(key)}));
            }
        }
        (Value::Array(old), Value::Array(new)) => compare_lists(old, new, at, out),
        _ => out.push(json!({"op": "replace", "path": at, "value": new})),
    }
}

/// Equal elements at both ends are kept; in the middle, elements are compared by index.
fn compare_lists(old: &[Value], new: &[Value], at: &str, out: &mut Vec<Value>) {
    if old.len() == new.len() {
        for (index, (old, new)) in old.iter().zip(new).enumerate() {
            compare(old, new, &format!("{at}/{index}"), out);
        }
        return;
    }
    let shorter = old.len().min(new.len());
    let start = (0..shorter).take_while(|i| old[*i] == new[*i]).count();
    let from_end = |i: &usize| old[old.len() - 1 - i] == new[new.len() - 1 - i];
    let end = (0..shorter - start).take_while(from_end).count();
    let (old, new) = (&old[start..old.len() - end], &new[start..new.len() - end]);
    let both = old.len().min(new.len());
    for index in 0..both {
        compare(&old[index], &new[index], &format!("{at}/{}", start + index), out);
    }
    for _ in both..old.len() {
        out.push(json!({"op": "remove", "path": format!("{at}/{}", start + both)}));
    }
    for (index, value) in new.iter().enumerate().skip(both) {
        let path = format!("{at}/{}", start + index);
        out.push(json!({"op": "add", "path": path, "value": value}));
    }
}

#[test]
fn patches_are_small_and_right() {
    let old = json!({"a": [1, 2, 3, 4], "b": {"x/y": 1, "z": [0]}, "c": 18});
    for (new, operations) in [
        (json!({"a": [1, 3, 4], "b": {"x/y": 1, "z": [0]}, "c": 18}), 1),
        (json!({"a": [1, 2, 9, 3, 4], "b": {"x/y": 1, "z": [0]}, "c": 18}), 1),
        (json!({"a": [1, 2, 3, 4, 5, 6], "b": {"x/y": 2, "z": []}, "c": 18}), 4),
        (json!({"a": [7, 8], "b": {"z": [0], "~": null}, "c": 18.0}), 7),
        (json!([]), 1),
    ] {
        let patch = patch(&old, &new);
        assert_eq!(patch.0.len(), operations, "{new}");
        let mut patched = old.clone();
        json_patch::patch(&mut patched, &patch).expect("it fits");
        assert_eq!(patched, new);
    }
}
