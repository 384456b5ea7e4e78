//! A document to be written: in memory as a whole, or serialised row by row to save memory.

use std::sync::Arc;

use serde_json::{Value, json};
use urdd_directory::canonical;
use urdd_directory::writer::*;

#[test]
fn row_by_row_is_as_the_whole() {
    let rows = json!([[1, 2], [[], [1.5]], {"a": {"b": [[]]}, "c": "no"}, {}, [], [null]]);
    let list = rows.as_array().unwrap().clone();
    let whole = json!({
        "first": rows, "none": null, "empty": [], "last": [[0]],
        "inner": {"number": 1, "shared": rows, "deeper": {"values": {"a": [{"b": []}]}}},
    });
    let shared = Arc::new((7, list.clone()));
    let deeper = Member::Value(json!({"a": [{"b": []}]}));
    let object = Document::Object(vec![
        ("first", Member::Rows(Rows::new(list))),
        ("none", Member::rows_or_null(None)),
        ("empty", Member::Rows(Rows::new(Vec::<Value>::new()))),
        ("last", Member::rows_or_null(Some(Rows::new(vec![[0]])))),
        (
            "inner",
            Member::Object(vec![
                ("number", Member::Value(json!(1))),
                ("shared", Member::Rows(Rows::of(&shared, |(_, list)| list))),
                ("deeper", Member::Object(vec![("values", deeper)])),
            ]),
        ),
    ]);
    let (mut json, mut yaml) = (String::new(), String::new());
    object.json(&mut json).unwrap();
    object.yaml(&mut yaml).unwrap();
    assert_eq!(json, canonical::json_string(&whole));
    assert_eq!(yaml, canonical::yaml_string(&whole));
}
