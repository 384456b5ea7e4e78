use serde_json::{Value, json};
use urdd_validate::code::Code::*;

use crate::{Case, invalid, near_miss};
use testkit::fixture::Fixture;

const FOLDER: &str = "x_acme_gripper_module";

fn extend(f: &mut Fixture, schema: &[u8], document: Value) {
    f.put_file(&format!("{FOLDER}/schema.json"), schema);
    f.add_module(FOLDER, document);
}

pub fn cases() -> Vec<Case> {
    let schema = |schema: Value| {
        move |f: &mut Fixture| extend(f, schema.to_string().as_bytes(), json!({"grip": [1]}))
    };
    vec![
        invalid(EXT001, "no-schema", |f| f.add_module(FOLDER, json!({}))),
        invalid(EXT001, "not-json", |f| extend(f, b"{", json!({}))),
        invalid(EXT001, "no-type-of-that-name", schema(json!({"type": "strin"}))),
        invalid(EXT001, "file", schema(json!({"$ref": "other.json"}))),
        invalid(EXT001, "url", schema(json!({"$ref": "http://localhost:1/schema.json"}))),
        invalid(EXT001, "no-such-definition", schema(json!({"$ref": "#/$defs/a"}))),
        invalid(EXT001, "lookahead", schema(json!({"patternProperties": {"^(?=a)": true}}))),
        invalid(
            EXT001,
            "reference-to-a-group",
            schema(json!({"propertyNames": {"pattern": "^(a+)\\1$"}})),
        ),
        near_miss(
            EXT001,
            "all-that-may-be",
            schema(json!({
                "$schema": "https://json-schema.org/draft/2020-12/schema",
                "$id": "https://example.com/gripper.json",
                "properties": {"grip": {"$ref": "#/$defs/grip"}},
                "$defs": {"grip": {"items": {"$ref": "#positive"}},
                          "positive": {"$anchor": "positive", "minimum": 0}},
            })),
        ),
        invalid(
            EXT002,
            "wrong-type",
            schema(json!({
                "properties": {"grip": {"items": {"type": "string"}}},
            })),
        ),
        invalid(EXT002, "false", schema(json!(false))),
        near_miss(
            EXT002,
            "integer",
            schema(json!({
                "properties": {"grip": {"items": {"type": "integer"}}},
            })),
        ),
    ]
}
