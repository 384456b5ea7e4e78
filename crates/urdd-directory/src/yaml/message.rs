//! Messages about a YAML mirror.

use saphyr_parser::ScanError;
use serde_json::Value;

use super::super::canonical::{self, yaml_quoted};
use super::super::text_fault::{TextFault, TextFaultKind};
use super::scalar::{Reading, Readings};
use urdd_format::short::cut;

/// Longer excerpts are truncated.
const LONGEST_EXCERPT: usize = 80;

/// A short description of a value.
pub fn describe(value: &Value) -> String {
    match value {
        Value::Array(list) => format!("a list of {}", list.len()),
        Value::Object(map) => format!("a mapping of {}", map.len()),
        scalar => excerpt(&canonical::yaml_inline(scalar)),
    }
}

/// The beginning of a text, on one line.
pub fn excerpt(text: &str) -> String {
    cut(text, LONGEST_EXCERPT).replace(['\n', '\r'], " ")
}

/// A value that differs from the JSON.
pub fn differs(found: &str, json: &Value) -> TextFault {
    let expected = describe(json);
    let message = format!("the YAML has {found} where the JSON has {expected}");
    TextFault::new(TextFaultKind::YamlDiffers, message).expecting(expected).finding(found)
}

/// A plain scalar for messages: strings quoted, anything else as written.
pub fn found(text: &str, reading: Reading) -> String {
    match reading {
        Reading::Text => excerpt(&yaml_quoted(text)),
        Reading::Null if text.is_empty() => "nothing".to_owned(),
        _ => excerpt(text),
    }
}

/// A plain scalar that readers interpret differently.
pub fn ambiguous(text: &str, readings: Readings, json: Option<&Value>) -> TextFault {
    let shown = excerpt(text);
    let instead = match json {
        Some(json) if !json.is_array() && !json.is_object() => describe(json),
        _ => excerpt(&yaml_quoted(text)),
    };
    let (new, old) = (name(readings.yaml12), name(readings.yaml11));
    let how = if new == old {
        format!("{new} to YAML 1.2 and another, or a string, to YAML 1.1 readers")
    } else {
        format!("{new} to YAML 1.2 and {old} to YAML 1.1 readers such as PyYAML")
    };
    let message = format!("`{shown}` is {how}: write `{instead}`");
    let fault = TextFault::new(TextFaultKind::YamlAmbiguousScalar, message).finding(shown);
    TextFault { expected: json.map(describe), ..fault }
}

/// A plain scalar that PyYAML cannot read inside brackets.
pub fn question_mark(text: &str) -> TextFault {
    let shown = excerpt(text);
    let message = format!(
        "`{shown}` has a `?`, which YAML 1.1 readers such as PyYAML refuse between brackets: write `{}`",
        excerpt(&yaml_quoted(text))
    );
    TextFault::new(TextFaultKind::YamlAmbiguousScalar, message)
}

fn name(reading: Reading) -> &'static str {
    match reading {
        Reading::Null => "null",
        Reading::Bool(true) => "true",
        Reading::Bool(false) => "false",
        Reading::Integer | Reading::Float => "a number",
        Reading::NonFinite => "not a finite number",
        Reading::Text => "a string",
        Reading::Timestamp => "a date",
        Reading::Special => "an operator",
    }
}

/// A key that is not a string.
pub fn not_a_string(text: &str, reading: Reading) -> TextFault {
    let message = format!(
        "the key {} is {}, but keys are strings: write `{}`",
        found(text, reading),
        name(reading),
        excerpt(&yaml_quoted(text))
    );
    TextFault::new(TextFaultKind::YamlNonStringKey, message)
}

/// A key that is missing in the JSON.
pub fn extra_key(key: &str) -> TextFault {
    let key = excerpt(key);
    let message = format!("the YAML has a key `{key}` that the JSON lacks");
    TextFault::new(TextFaultKind::YamlDiffers, message).finding(key)
}

/// A key that is missing in the YAML.
pub fn missing_key(key: &str, value: &Value) -> TextFault {
    let message = format!("the YAML lacks the key `{}`", excerpt(key));
    TextFault::new(TextFaultKind::YamlDiffers, message).expecting(describe(value))
}

/// A duplicate key.
pub fn repeated_key(key: &str) -> TextFault {
    let message = format!(
        "the key `{}` occurs twice in its mapping: readers differ in which one they keep; remove one",
        excerpt(key)
    );
    TextFault::new(TextFaultKind::YamlDuplicateKey, message)
}

/// A list of a different length.
pub fn length(found: usize, expected: usize) -> TextFault {
    let message = format!("the YAML has a list of {found} where the JSON has a list of {expected}");
    let fault = TextFault::new(TextFaultKind::YamlDiffers, message);
    fault.expecting(expected.to_string()).finding(found.to_string())
}

/// Why the parser stopped.
pub fn unparsed(text: &str, error: &ScanError) -> String {
    let reason = error.info();
    if reason.contains("end of stream") || text.chars().count() <= error.marker().index() {
        format!("the file ends early, before its YAML is complete: {reason}")
    } else {
        format!("not YAML: {reason}")
    }
}
