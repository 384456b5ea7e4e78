//! Properties of the faults of every text.

use serde_json::Value;
use urdd_directory::position::TextFaults;

/// Every fault has a message, and a location within the text.
pub fn check_faults(faults: &TextFaults, bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let lines = text.split(['\n', '\r']).count();
    for fault in faults {
        assert!(!fault.message.is_empty(), "{fault:?}");
        let place = fault.position.expect("every fault has a place");
        assert!(place.line >= 1 && place.column >= 1, "{fault:?}");
        assert!(place.line as usize <= lines, "{fault:?} of {lines} lines");
        assert!(place.column as usize <= bytes.len() + 1, "{fault:?}");
        assert!(faults.total(fault.kind) > 0);
    }
}

/// Whether two documents are equal: 1 and 1.0 are the same number, and members have no order.
pub fn same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => a == b || a.as_f64() == b.as_f64(),
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| same(a, b)))
        }
        _ => a == b,
    }
}

/// The leaves of a document with their JSON Pointers, at most `most`.
pub fn leaves(document: &Value, most: usize) -> Vec<(String, &Value)> {
    let mut open = vec![(String::new(), document)];
    let mut found = Vec::new();
    while let Some((pointer, value)) = open.pop() {
        let escape = |key: &str| key.replace('~', "~0").replace('/', "~1");
        match value {
            Value::Array(list) => open.extend(
                list.iter().enumerate().map(|(index, value)| (format!("{pointer}/{index}"), value)),
            ),
            Value::Object(map) => open.extend(
                map.iter().map(|(key, value)| (format!("{pointer}/{}", escape(key)), value)),
            ),
            _ => found.push((pointer, value)),
        }
        if found.len() >= most || open.len() > 100 * most {
            break;
        }
    }
    found
}
