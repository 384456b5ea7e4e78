//! The published schemas: each is valid and named, and released ones do not change. A test of the program compares the
//! committed folder with the types.

use std::collections::BTreeSet;

use serde_json::json;
use urdd_format::schema::{self, SchemaError, Subject, Variant, validating_hash, validating_part};

/// Schemas that may still change: those of the next version of the program, until its release.
const UNRELEASED: &[&str] = &["validator_result@1.2.0", "report@1.2.0"];

#[test]
fn every_schema_is_released() {
    let released = schema::released().unwrap();
    let mut listed: Vec<&str> = released.iter().map(|release| release.id.as_str()).collect();
    listed.extend(UNRELEASED);
    listed.sort_unstable();
    let mut known: Vec<String> = Subject::all().map(Subject::id).collect();
    known.sort_unstable();
    assert_eq!(listed, known, "each schema is in released.json, or above while it may change");
}

#[test]
fn every_schema_is_a_valid_one_with_an_id_a_title_and_a_text_of_its_own() {
    let mut ids = BTreeSet::new();
    for subject in Subject::all() {
        for variant in [Variant::Strict, Variant::Open] {
            let schema = subject.schema(variant);
            assert!(jsonschema::draft202012::meta::is_valid(&schema), "{}", subject.id());
            assert!(schema["title"].is_string());
            assert!(schema["description"].is_string());
            assert!(ids.insert(schema["$id"].to_string()));
            let text = subject.text(variant);
            assert!(text.ends_with("}\n") && !text.ends_with("\n\n"));
            assert_eq!(text.contains("additionalProperties"), variant == Variant::Strict);
        }
        assert_eq!(Subject::find(&subject.id()).unwrap().id(), subject.id());
    }
}

#[test]
fn annotations_do_not_count_and_names_that_look_like_them_do() {
    let one = json!({
        "$id": "a", "title": "A", "description": "a", "type": "object",
        "properties": { "title": { "type": "string", "description": "b" }, "x": { "enum": [2, 1] } },
        "required": ["x", "title"],
    });
    let same = json!({
        "type": "object", "required": ["title", "x"],
        "properties": { "x": { "enum": [1, 2] }, "title": { "type": "string", "$comment": "c" } },
    });
    let mut other = same.clone();
    other["properties"]["title"]["type"] = json!("number");
    assert_eq!(validating_part(&one), validating_part(&same));
    assert_eq!(validating_hash(&one), validating_hash(&same));
    assert_ne!(validating_hash(&one), validating_hash(&other));
    assert_eq!(validating_part(&one)["properties"]["title"], json!({ "type": "string" }));
}

#[test]
fn an_unknown_id_is_answered_with_those_that_look_like_it() {
    let near = |id| match Subject::find(id) {
        Err(SchemaError::UnknownId { near, .. }) => near,
        _ => panic!("{id} is known"),
    };
    let versions = ["dof_module@1.0.0", "dof_module@0.0.2", "dof_module@0.0.1"];
    assert_eq!(near("dof_module@9.9.9"), versions);
    assert_eq!(near("dof_modul@1.0.0"), versions);
    assert_eq!(near("rootmetadata"), ["root_metadata@1.0.0"]);
    assert_eq!(near("zzzzzzz"), [""; 0]);
    assert_eq!(near(""), [""; 0]);
}
