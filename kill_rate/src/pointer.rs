//! JSON Pointers (RFC 6901), and the fields that they refer to.

use std::collections::BTreeMap;

use serde_json::Value;

/// The places of a document by field. A field is a pointer with `*` for list indices. Excludes keys that begin with
/// `x_`, and `$schema` (SPEC 3.1.2).
pub(crate) fn fields(document: &Value) -> BTreeMap<String, Vec<String>> {
    let mut fields = BTreeMap::new();
    collect(document, String::new(), String::new(), &mut fields);
    fields
}

fn collect(value: &Value, pointer: String, field: String, out: &mut BTreeMap<String, Vec<String>>) {
    match value {
        Value::Object(map) => {
            for (key, value) in map.iter().filter(|(key, _)| is_field(key)) {
                let key = escape(key);
                collect(value, format!("{pointer}/{key}"), format!("{field}/{key}"), out);
            }
        }
        Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                collect(value, format!("{pointer}/{index}"), format!("{field}/*"), out);
            }
        }
        _ => {}
    }
    out.entry(field).or_default().push(pointer);
}

/// Whether a key is defined by the format.
pub(crate) fn is_field(key: &str) -> bool {
    !key.starts_with("x_") && key != "$schema"
}

/// Escapes a key for use in a pointer.
pub(crate) fn escape(key: &str) -> String {
    key.replace('~', "~0").replace('/', "~1")
}

/// Unescapes a part of a pointer to a key.
pub(crate) fn unescape(part: &str) -> String {
    part.replace("~1", "/").replace("~0", "~")
}

/// The pointer of the enclosing object or list, and the last part as a key.
pub(crate) fn parent(pointer: &str) -> Option<(&str, String)> {
    let (parent, last) = pointer.rsplit_once('/')?;
    Some((parent, unescape(last)))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn fields_gather_places() {
        let found = fields(&json!({"a": [[1], [2]], "x_b": 1, "$schema": "", "c/d": null}));
        let names: Vec<&str> = found.keys().map(String::as_str).collect();
        assert_eq!(names, ["", "/a", "/a/*", "/a/*/*", "/c~1d"]);
        assert_eq!(found["/a/*/*"], ["/a/0/0", "/a/1/0"]);
    }
}
