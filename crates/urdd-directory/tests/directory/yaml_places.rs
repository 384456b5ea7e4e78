//! YAML as a value, with the place of each part.

use serde_json::json;
use urdd_directory::limits::DEPTH_LIMIT;
use urdd_directory::yaml::places::*;

#[test]
fn each_part_has_its_value_and_its_place() {
    let text = "a: 1\nb:\n  - x\n  - {c: null, d: [2.5, \"é\"]}\n\"e/f\": {}\n";
    let yaml = read(text).expect("YAML");
    assert_eq!(yaml.value, json!({"a": 1, "b": ["x", {"c": null, "d": [2.5, "é"]}], "e/f": {}}));
    for (what, pointer) in [
        ("a", "/a"),
        ("1", "/a"),
        ("b:", "/b"),
        ("x", "/b/0"),
        ("c:", "/b/1/c"),
        ("null", "/b/1/c"),
        ("2.5", "/b/1/d/0"),
        ("\"é", "/b/1/d/1"),
        ("\"e/f", "/e~1f"),
    ] {
        let offset = text.find(what).unwrap();
        assert_eq!(yaml.pointer_at(offset), Some(pointer), "{what}");
    }
    assert_eq!(yaml.range("/b/1/d/0").map(|range| &text[range]), Some("2.5"));
}

#[test]
fn what_is_no_json_is_not_read() {
    for text in ["", "a: &x 1\nb: *x", "- &x 1\n- *x", "? [1]\n: 2", "a: .nan", "a: [", "- 1\nb"] {
        assert!(read(text).is_none(), "{text}");
    }
    for (end, _) in "a:\n - {b: [1, 'x']}\n - |\n  é\n".char_indices() {
        let _ = read(&"a:\n - {b: [1, 'x']}\n - |\n  é\n"[..end]);
    }
}

#[test]
fn nesting_is_bounded() {
    let nested = |levels: usize| format!("{}1{}", "[".repeat(levels), "]".repeat(levels));
    assert!(read(&nested(DEPTH_LIMIT)).is_some());
    assert!(read(&nested(DEPTH_LIMIT + 1)).is_none());
}

/// A key is in the pointer of all that is below it: one of a megabyte took that for each value.
#[test]
fn long_keys_are_not_in_every_place() {
    let key = "k".repeat(1 << 20);
    let text = |key: &str| format!("{key}:\n{}", "- 1\n".repeat(100_000));
    assert!(read(&text(&key)).is_none());
    // One that readers take in spite of its length.
    let text_of = |key: &str| format!("? {key}\n:\n{}", "  - 1\n".repeat(200));
    assert!(read(&text_of("key")).is_some() && read(&text_of(&key)).is_none());
    let document = read(&text("key")).expect("a document");
    assert_eq!(document.range("/key/99999"), Some(400_003..400_004));
}
