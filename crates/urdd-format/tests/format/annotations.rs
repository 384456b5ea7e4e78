//! The `x-` keywords of schemas.

use serde_json::{Value, json};
use urdd_format::annotations::*;

#[test]
fn units_are_products_of_symbols_or_a_choice() {
    for right in
        ["1", "m", "rad", "kg*m^2", "N*m", "1/s", "N*m*s/rad", "rad or m", "1 or rad/m or m/rad"]
    {
        assert!(is_unit(right), "{right}");
    }
    for wrong in [
        "",
        "deg",
        "mm",
        "m^1",
        "m^10",
        "m^",
        "^2",
        "m m",
        "m*",
        "/s",
        "m/",
        "m/s/s",
        "m/1",
        "2",
        "m or",
        "rad  or m",
        "rad or deg",
        "1*m",
        "M",
    ] {
        assert!(!is_unit(wrong), "{wrong}");
    }
}

#[test]
fn a_choice_names_all_its_things() {
    assert_eq!(of_index("link"), Some(vec![Thing::Link]));
    assert_eq!(of_index("visual or collision"), Some(vec![Thing::Visual, Thing::Collision]));
    assert_eq!(of_index("links"), None);
    assert_eq!(of_length("links"), Some(vec![Thing::Link]));
    assert_eq!(of_length("link"), None);
    assert_eq!(of_length("samples"), None);
    assert_eq!(of_length(""), None);
    for (thing, index, length) in THINGS {
        assert_eq!((thing.index(), thing.length()), (index, length));
    }
}

#[test]
fn faults_say_what_to_write() {
    let first = |schema: Value| {
        let found = faults(schema.as_object().expect("an object"));
        found.first().map(ToString::to_string)
    };
    assert_eq!(first(json!({"x-index": "link", "type": "integer"})), None);
    assert_eq!(first(json!({"x-index": "link"})), None);
    assert_eq!(first(json!({"x-index": "link", "type": ["number", "null"]})), None);
    assert_eq!(first(json!({"x-mine": 7})), None);
    let message = first(json!({"x-index": 7})).expect("a fault");
    assert!(message.starts_with("`x-index` is 7, and must be a string: write link, joint"));
    let message = first(json!({"x-length": "link"})).expect("a fault");
    assert!(message.contains("is `link`, which is not defined: did you mean `links`?"));
    let message = first(json!({"x-index": "link", "type": "array"})).expect("a fault");
    assert!(message.contains("put it into `items`"));
    assert!(first(json!({"x-length": "links", "type": "object"})).is_some());
    let message = first(json!({"x-unit": "m\u{1b}[2J"})).expect("a fault");
    assert!(!message.contains('\u{1b}'), "{message}");
}

#[test]
fn a_sentence_names_what_is_inside_too() {
    let pieces = json!({"type": "integer", "x-index": "piece"});
    let schema = json!({
        "x-length": "links",
        "items": {"x-length": "pieces", "items": pieces},
    });
    assert_eq!(sentence(&schema), "Index of: `piece`. Length: `links`, each `pieces`.");
    assert_eq!(sentence(&json!({"x-unit": "m", "x-frame": "link"})), "Unit: `m`. Frame: `link`.");
    assert_eq!(sentence(&json!({"type": "string"})), "");
}
