//! The JSON reader, against `serde_json`.

use serde_json::Value;
use urdd_directory::position::TextFaultKind as Kind;
use urdd_directory::{canonical, json, json_scan};

use super::text::{check_faults, leaves};

/// How many values of a document are looked up by their pointers: each costs a walk over the text.
const LOOKED_UP: usize = 20;

/// `serde_json` accepts the same documents with the same values; the canonical emission reads back; each value is found
/// at its location.
pub fn json(bytes: &[u8]) {
    // A byte order mark is a fault here, and unreadable there.
    let unmarked = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let peer = serde_json::from_slice::<Value>(unmarked);
    let document = match json::read(bytes) {
        Ok(document) => document,
        Err(unreadable) => {
            assert!(!unreadable.faults.is_empty());
            assert!(!unreadable.to_string().is_empty());
            check_faults(&unreadable.faults, bytes);
            let is_deep = unreadable.faults.total(Kind::TooDeep) > 0;
            assert!(peer.is_err() || is_deep, "{unreadable}: and serde_json reads it");
            return;
        }
    };
    check_faults(&document.faults, bytes);
    assert_eq!(document.value, peer.expect("serde_json reads it too"));

    let text = canonical::json_string(&document.value);
    let again = json::read(text.as_bytes()).expect("canonical JSON is JSON");
    assert!(again.faults.is_empty(), "{:?}", again.faults);
    assert_eq!(again.value, document.value);
    assert_eq!(canonical::json_string(&again.value), text);

    for (pointer, value) in leaves(&document.value, LOOKED_UP) {
        let found = json_scan::find_values(&document.text, &[&pointer]);
        let offset = found[0].expect("it is there");
        let mut rest = serde_json::Deserializer::from_str(&document.text[offset..]).into_iter();
        let found: Option<Result<Value, _>> = rest.next();
        assert_eq!(found.expect("a value").expect("a value"), *value, "{pointer}");
        let around = json_scan::pointer_at(&document.text, offset + 1);
        assert_eq!(around, pointer);
    }
}
