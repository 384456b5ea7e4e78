//! Edits of a document.

use serde_json::{Map, Value};

use super::pointer;
use urdd_directory::canonical;

/// Marks the second of two equal keys until the text is written. It occurs in no key of the format.
const DOUBLED: &str = "\u{e000}doubled";

/// An edit of a document.
#[derive(Debug, Clone)]
pub(crate) enum Edit {
    /// Replaces a value.
    Set(String, Value),
    /// Renames the key at a pointer.
    Rename(String, String),
    /// Removes a key with its value.
    Remove(String),
    /// Duplicates a key with its value.
    Double(String),
    /// Adds a key to the object at a pointer.
    Add(String, String),
}

/// Applies edits to a document. `None` if one of them does not apply.
pub(crate) fn apply(document: &Value, edits: &[Edit]) -> Option<Value> {
    let mut document = document.clone();
    for edit in edits {
        match edit {
            Edit::Set(place, value) => *document.pointer_mut(place)? = value.clone(),
            Edit::Remove(place) => {
                let (object, key) = object(&mut document, place)?;
                object.shift_remove(&key)?;
            }
            Edit::Rename(place, to) => {
                let (object, key) = object(&mut document, place)?;
                let renamed = |(name, value): (String, Value)| match name == key {
                    true => (to.clone(), value),
                    false => (name, value),
                };
                *object = std::mem::take(object).into_iter().map(renamed).collect();
            }
            Edit::Double(place) => {
                let (object, key) = object(&mut document, place)?;
                let value = object.get(&key)?.clone();
                object.insert(format!("{DOUBLED}{key}"), value);
            }
            Edit::Add(place, key) => {
                let object = document.pointer_mut(place)?.as_object_mut()?;
                object.insert(key.clone(), Value::Null);
            }
        }
    }
    Some(document)
}

fn object<'a>(
    document: &'a mut Value,
    place: &str,
) -> Option<(&'a mut Map<String, Value>, String)> {
    let (parent, key) = pointer::parent(place)?;
    Some((document.pointer_mut(parent)?.as_object_mut()?, key))
}

/// The canonical JSON of an edited document.
pub(crate) fn json(document: &Value) -> Vec<u8> {
    canonical::json_string(document).replace(DOUBLED, "").into_bytes()
}

/// The canonical YAML of an edited document.
pub(crate) fn yaml(document: &Value) -> Vec<u8> {
    let text = canonical::yaml_string(document);
    match text.contains(DOUBLED) {
        // In YAML the mark forces quotes around the key, which do not change its meaning.
        true => text.replace(DOUBLED, "").into_bytes(),
        false => text.into_bytes(),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn edits_keep_the_order_of_keys() {
        let document = json!({"a": {"b": 1, "c": [2, 3]}, "d": 4});
        let after = |edit| String::from_utf8(json(&apply(&document, &[edit]).unwrap())).unwrap();
        let flat = |text: String| text.replace(['\n', ' '], "");
        let renamed = after(Edit::Rename("/a/b".to_owned(), "x".to_owned()));
        assert_eq!(flat(renamed), r#"{"a":{"x":1,"c":[2,3]},"d":4}"#);
        let doubled = after(Edit::Double("/a/b".to_owned()));
        assert_eq!(flat(doubled), r#"{"a":{"b":1,"c":[2,3],"b":1},"d":4}"#);
        let removed = after(Edit::Remove("/a".to_owned()));
        assert_eq!(flat(removed), r#"{"d":4}"#);
        let set = after(Edit::Set("/a/c/1".to_owned(), json!(null)));
        assert_eq!(flat(set), r#"{"a":{"b":1,"c":[2,null]},"d":4}"#);
        assert!(apply(&document, &[Edit::Remove("/z".to_owned())]).is_none());
        let doubled = apply(&document, &[Edit::Double("/d".to_owned())]).unwrap();
        let yaml = String::from_utf8(yaml(&doubled)).unwrap();
        assert!(yaml.ends_with("d: 4\n\"d\": 4\n"), "{yaml}");
    }
}
