//! C++ types of all documents, written from the published schemas: `cpp/include/urdd_types.hpp`.

use std::fmt::Write;

use serde_json::{Map, Value};
use urdd_format::bundle::bundle;
use urdd_format::registry::ModuleKind;
use urdd_format::schema::Variant;

use crate::schema_comment;

const FILE: &str = "cpp/include/urdd_types.hpp";

const HEAD: &str = "\
// Types of the documents of a URDD of version 1, over nlohmann-json. Written from `schema/` by
// crates/urdd-format/tests/format/cpp_types.rs. Do not edit.
//
// Members are called as the keys are; those of objects of one key, and the values of enumerations, in lower case. What
// may be null or absent is a std::optional. Keys of extensions and of later minor versions are in `extra`, and are
// written again. Reading is in <urdd/json.hpp>, the text of files in <urdd/text.hpp>. Neither needs the library.

#ifndef URDD_TYPES_HPP
#define URDD_TYPES_HPP

#include \"urdd/json.hpp\"
#include \"urdd/text.hpp\"

namespace urdd::types {
";

const TAIL: &str = "
} // namespace urdd::types

#endif
";

/// Words that C++ keeps for itself, of those that are keys or values.
const KEPT: [&str; 1] = ["default"];

/// `URDD_UPDATE=1 cargo test --workspace --test format cpp_types` writes the file.
#[test]
fn the_cpp_types_are_what_the_schemas_say() {
    crate::is_written(FILE, "cpp_types", &types());
}

struct Types<'a> {
    definitions: &'a Map<String, Value>,
    /// Those that are written, or being written.
    begun: Vec<&'a str>,
    text: String,
}

fn types() -> String {
    let bundle = bundle(Variant::Strict);
    let definitions = bundle["$defs"].as_object().expect("definitions");
    let mut types = Types { definitions, begun: Vec::new(), text: HEAD.to_owned() };
    let objects = definitions.iter().filter(|(_, definition)| is_object(definition));
    types.text.push('\n');
    for (name, _) in objects {
        let _ = writeln!(types.text, "struct {name};");
    }
    for name in definitions.keys() {
        types.declare(name);
    }
    types.text.push_str(TAIL);
    types.text
}

fn is_object(definition: &Value) -> bool {
    definition["properties"].is_object()
}

impl<'a> Types<'a> {
    /// A type, after those that stand in it: C++ wants them whole.
    fn declare(&mut self, name: &'a str) {
        if self.begun.contains(&name) {
            return;
        }
        self.begun.push(name);
        let definition = &self.definitions[name];
        let mut needed = Vec::new();
        references(definition, &mut needed);
        needed.into_iter().for_each(|name| self.declare(name));
        self.text.push('\n');
        comment(definition, "", &mut self.text);
        if is_object(definition) {
            self.object(name, definition);
        } else if let Some(words) = definition["enum"].as_array() {
            self.enumeration(name, words);
        } else {
            let _ = writeln!(self.text, "using {name} = {};", type_of(definition));
        }
    }

    fn object(&mut self, name: &str, definition: &Value) {
        let mut text = std::mem::take(&mut self.text);
        let _ = writeln!(text, "struct {name} {{");
        let required = definition["required"].as_array().expect("what is required");
        let mut visits = String::new();
        for (key, schema) in definition["properties"].as_object().expect("properties") {
            let is_required = required.contains(&key.as_str().into());
            let of = type_of(schema);
            let (of, visit) = match is_required {
                true => (of, "required"),
                false => (format!("std::optional<{of}>"), "optional"),
            };
            let member = member(key);
            comment(schema, "    ", &mut text);
            let start = if matches!(of.as_str(), "double" | "std::size_t" | "bool")
                || self.is_enumeration(&of)
            {
                "{}"
            } else {
                ""
            };
            let _ = writeln!(text, "    {of} {member}{start};");
            let _ = writeln!(visits, "        visitor.{visit}(\"{key}\", self.{member});");
        }
        text.push_str("    /// Other keys: `x_` and those of later minor versions. An object, or null.\n    Json extra;\n\n");
        if let Some(kind) = module_of(definition) {
            let depends_on = kind.depends_on().iter().map(|kind| format!("\"{}\"", kind.name()));
            let depends_on = depends_on.collect::<Vec<_>>();
            let _ = writeln!(
                text,
                "    static constexpr const char *module_name{{\"{}\"}};\n    \
                 static constexpr const char *module_folder{{\"{}\"}};\n    \
                 static constexpr const char *module_version{{\"1.0.0\"}};\n    \
                 static constexpr std::array<const char *, {}> depends_on{{{}}};\n",
                kind.name(),
                kind.folder(),
                depends_on.len(),
                depends_on.join(", "),
            );
        }
        let _ = writeln!(
            text,
            "    template <class Self, class Visitor> static void members(Self &self, Visitor &visitor) {{\n{visits}        \
             visitor.extra(self.extra);\n    }}\n}};"
        );
        self.text = text;
    }

    fn is_enumeration(&self, name: &str) -> bool {
        let definition = self.definitions.get(name);
        definition.is_some_and(|definition| definition["enum"].is_array())
    }

    fn enumeration(&mut self, name: &str, words: &[Value]) {
        let words = words.iter().map(|word| word.as_str().expect("a word"));
        let words = words.collect::<Vec<_>>();
        let members = words.iter().map(|word| member(word)).collect::<Vec<_>>();
        let quoted = words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>();
        let _ = writeln!(
            self.text,
            "enum class {name} {{ {} }};\n\n\
             template <> struct detail::Words<{name}> {{\n    \
             static constexpr std::array<std::string_view, {}> words{{{}}};\n}};",
            members.join(", "),
            words.len(),
            quoted.join(", "),
        );
    }
}

/// The module whose document this is.
fn module_of(definition: &Value) -> Option<ModuleKind> {
    let title = definition["title"].as_str()?;
    let name = snake(title);
    ModuleKind::ALL.iter().copied().find(|kind| kind.name() == name)
}

fn references<'a>(schema: &'a Value, found: &mut Vec<&'a str>) {
    match schema {
        Value::Object(object) => {
            if let Some(reference) = object.get("$ref").and_then(Value::as_str) {
                found.push(reference.trim_start_matches("#/$defs/"));
            }
            object.values().for_each(|value| references(value, found));
        }
        Value::Array(list) => list.iter().for_each(|value| references(value, found)),
        _ => {}
    }
}

/// `RotationVector` as `rotation_vector`; a key in lower case as it is.
fn snake(word: &str) -> String {
    let mut snake = String::new();
    for (at, letter) in word.trim_start_matches('$').char_indices() {
        if letter.is_ascii_uppercase() && at > 0 {
            snake.push('_');
        }
        snake.push(letter.to_ascii_lowercase());
    }
    snake
}

/// The name of the member of a key, or of the value of a word.
fn member(key: &str) -> String {
    let name = snake(key);
    match KEPT.contains(&name.as_str()) {
        true => name + "_",
        false => name,
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
            let is_null = |choice: &&Value| choice["type"] == "null";
            let kinds = choices.iter().filter(|choice| !is_null(choice)).map(type_of);
            let kinds = kinds.collect::<Vec<_>>();
            let of = match kinds.as_slice() {
                [only] if choices.len() > 1 => only.clone(),
                kinds => format!("std::variant<{}>", kinds.join(", ")),
            };
            return match choices.iter().any(|choice| is_null(&choice)) {
                true => format!("std::optional<{of}>"),
                false => of,
            };
        }
    }
    let (kind, is_optional) = match &schema["type"] {
        Value::Array(kinds) => match kinds.as_slice() {
            [kind, null] if null == "null" => (kind, true),
            kinds => panic!("a type of {kinds:?}"),
        },
        kind => (kind, false),
    };
    let of = match kind.as_str().expect("a type") {
        "boolean" => "bool".to_owned(),
        "integer" => {
            assert_eq!(schema["minimum"], 0, "{schema}");
            "std::size_t".to_owned()
        }
        "number" => "double".to_owned(),
        "string" => "std::string".to_owned(),
        "array" => list(schema),
        kind => panic!("a value of the type {kind}"),
    };
    match is_optional {
        true => format!("std::optional<{of}>"),
        false => of,
    }
}

fn list(schema: &Value) -> String {
    let item = type_of(&schema["items"]);
    match (schema["minItems"].as_u64(), schema["maxItems"].as_u64()) {
        (Some(least), Some(most)) if least == most => format!("std::array<{item}, {most}>"),
        _ => format!("std::vector<{item}>"),
    }
}

fn comment(schema: &Value, indent: &str, text: &mut String) {
    for line in schema_comment::lines(schema, 116 - indent.len()) {
        let space = if line.is_empty() { "" } else { " " };
        let _ = writeln!(text, "{indent}///{space}{line}");
    }
}
