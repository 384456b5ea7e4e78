//! The wording of what is wrong with a YAML mirror.

use serde_json::Value;

use super::canonical;
use super::text_fault::{TextFault, TextFaultKind};
use super::yaml_scalar::{Reading, Readings};

/// Longer excerpts are cut, so that a message stays a message.
const LONGEST_EXCERPT: usize = 80;

/// A value in a few words.
pub fn describe(value: &Value) -> String {
    match value {
        Value::Array(list) => format!("a list of {}", list.len()),
        Value::Object(map) => format!("a mapping of {}", map.len()),
        scalar => excerpt(&canonical::yaml_inline(scalar)),
    }
}

/// The beginning of a text, on one line.
pub fn excerpt(text: &str) -> String {
    let mut short: String = text.chars().take(LONGEST_EXCERPT).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    short.replace(['\n', '\r'], " ")
}

/// A scalar that is not the JSON value.
pub fn differs(found: &str, json: &Value) -> TextFault {
    let expected = describe(json);
    let message = format!("the YAML has {found} where the JSON has {expected}");
    TextFault {
        expected: Some(expected),
        found: Some(found.to_owned()),
        ..TextFault::new(TextFaultKind::YamlDiffers, message)
    }
}

/// A plain scalar as a message shows it: strings in quotes, anything else as it stands.
pub fn found(text: &str, reading: Reading) -> String {
    match reading {
        Reading::Text => excerpt(&canonical::yaml_quoted(text)),
        Reading::Null if text.is_empty() => "nothing".to_owned(),
        _ => excerpt(text),
    }
}

/// A plain scalar that readers disagree about.
pub fn ambiguous(text: &str, readings: Readings, json: Option<&Value>) -> TextFault {
    let shown = excerpt(text);
    let instead = match json {
        Some(json) if !json.is_array() && !json.is_object() => describe(json),
        _ => excerpt(&canonical::yaml_quoted(text)),
    };
    let (new, old) = (name(readings.yaml12), name(readings.yaml11));
    let how = if new == old {
        format!("{new} to YAML 1.2 and another, or a string, to YAML 1.1 readers")
    } else {
        format!("{new} to YAML 1.2 and {old} to YAML 1.1 readers such as PyYAML")
    };
    TextFault {
        expected: json.map(describe),
        found: Some(shown.clone()),
        ..TextFault::new(
            TextFaultKind::YamlAmbiguousScalar,
            format!("`{shown}` is {how}: write `{instead}`"),
        )
    }
}

/// A plain scalar that PyYAML cannot read between brackets.
pub fn question_mark(text: &str) -> TextFault {
    let shown = excerpt(text);
    let message = format!(
        "`{shown}` has a `?`, which YAML 1.1 readers such as PyYAML refuse between brackets: write `{}`",
        excerpt(&canonical::yaml_quoted(text))
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
        "the key {} is {}, and keys are strings: write `{}`",
        found(text, reading),
        name(reading),
        excerpt(&canonical::yaml_quoted(text))
    );
    TextFault::new(TextFaultKind::YamlNonStringKey, message)
}

/// A tag, with what to write instead.
pub fn tag(tag: &str, name: &str, unit: bool, variant: bool) -> TextFault {
    let instead = if unit {
        format!("write `{name}` as a string")
    } else if variant {
        format!("write `{name}:` as a key, with the value below it")
    } else {
        "remove it".to_owned()
    };
    TextFault {
        found: Some(excerpt(tag)),
        ..TextFault::new(
            TextFaultKind::YamlTag,
            format!(
                "`{}` is a tag, which plain readers refuse: {instead}",
                excerpt(tag)
            ),
        )
    }
}
