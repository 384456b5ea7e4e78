//! TypeScript types of all documents, written from the published schemas: `wasm/npm/modules.d.ts`.

use std::fmt::Write;

use serde_json::Value;
use urdd_format::bundle::bundle;
use urdd_format::schema::Variant;

use crate::schema_comment;

const FILE: &str = "wasm/npm/modules.d.ts";

/// Columns of the text of a comment.
const WIDTH: usize = 100;

const HEAD: &str = "\
// Types of the documents of a URDD of version 1. Written from `schema/` by
// crates/urdd-format/tests/format/typescript.rs. Do not edit.

/** Keys of extensions, which any object may have. */
export interface Extensible {
  [key: `x_${string}`]: unknown;
}
";

/// `URDD_UPDATE=1 cargo test --workspace --test format typescript` writes the file.
#[test]
fn the_types_are_what_the_schemas_say() {
    crate::is_written(FILE, "typescript", &types());
}

fn types() -> String {
    let bundle = bundle(Variant::Strict);
    let mut text = HEAD.to_owned();
    let definitions = bundle["$defs"].as_object().expect("definitions");
    for (name, definition) in definitions {
        declaration(name, definition, &mut text);
    }
    text.push_str(
        "\n/** The documents by the names of their modules. */\nexport interface Documents {\n",
    );
    for (name, schema) in bundle["properties"].as_object().expect("documents") {
        let _ = writeln!(text, "  {}: {};", key(name), type_of(schema));
    }
    text.push_str("}\n");
    text
}

fn declaration(name: &str, definition: &Value, text: &mut String) {
    text.push('\n');
    comment(definition, "", text);
    let Some(properties) = definition["properties"].as_object() else {
        let _ = writeln!(text, "export type {name} = {};", type_of(definition));
        return;
    };
    let _ = writeln!(text, "export interface {name} extends Extensible {{");
    let required = definition["required"].as_array().expect("what is required");
    for (name, schema) in properties {
        comment(schema, "  ", text);
        let mark = if required.contains(&name.as_str().into()) { "" } else { "?" };
        let _ = writeln!(text, "  {}{mark}: {};", key(name), type_of(schema));
    }
    text.push_str("}\n");
}

/// A name as a key of an interface.
fn key(name: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'$');
    match name.bytes().all(plain) {
        true => name.to_owned(),
        false => format!("\"{name}\""),
    }
}

fn type_of(schema: &Value) -> String {
    if let Some(reference) = schema["$ref"].as_str() {
        return reference.trim_start_matches("#/$defs/").to_owned();
    }
    if let [only] = schema["allOf"].as_array().map_or(&[][..], Vec::as_slice) {
        return type_of(only);
    }
    for keyword in ["anyOf", "oneOf"] {
        if let Some(choices) = schema[keyword].as_array() {
            return choices.iter().map(type_of).collect::<Vec<_>>().join(" | ");
        }
    }
    if let Some(words) = schema["enum"].as_array() {
        return words.iter().map(Value::to_string).collect::<Vec<_>>().join(" | ");
    }
    let kinds = match &schema["type"] {
        Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
        kind => vec![kind.as_str().expect("a type")],
    };
    let words = kinds.into_iter().map(|kind| match kind {
        "integer" => "number".to_owned(),
        "array" => list(schema),
        kind => kind.to_owned(),
    });
    words.collect::<Vec<_>>().join(" | ")
}

fn list(schema: &Value) -> String {
    let item = type_of(&schema["items"]);
    match (schema["minItems"].as_u64(), schema["maxItems"].as_u64()) {
        (Some(least), Some(most)) if least == most => {
            let items = vec![item; usize::try_from(most).expect("a length")];
            format!("[{}]", items.join(", "))
        }
        _ if item.contains(' ') && !item.ends_with(']') => format!("({item})[]"),
        _ => format!("{item}[]"),
    }
}

/// The description of a schema and its annotations, as a comment.
fn comment(schema: &Value, indent: &str, text: &mut String) {
    let lines = schema_comment::lines(schema, WIDTH);
    if lines.is_empty() {
        return;
    }
    let _ = writeln!(text, "{indent}/**");
    for line in lines {
        let line = line.replace("*/", "*\\/");
        let space = if line.is_empty() { "" } else { " " };
        let _ = writeln!(text, "{indent} *{space}{line}");
    }
    let _ = writeln!(text, "{indent} */");
}
