//! JSON and YAML text of a document. All output goes through [`json`] and [`yaml`], so that the format is easy to
//! change.

use serde_json::{Number, Value};

/// The document as `module.json`: indented, innermost lists on one line.
pub fn json(document: &Value) -> Vec<u8> {
    let mut out = String::new();
    json_value(document, 0, &mut out);
    out.push('\n');
    out.into_bytes()
}

/// The same document as `module.yaml`: block style, innermost lists in flow style.
pub fn yaml(document: &Value) -> Vec<u8> {
    let mut out = String::new();
    if is_nested(document) {
        yaml_block(document, 0, &mut out);
    } else {
        yaml_flow(document, &mut out);
        out.push('\n');
    }
    out.into_bytes()
}

/// Whether a value fits on one line: a scalar, a list of scalars, or an empty object.
fn is_flat(value: &Value) -> bool {
    match value {
        Value::Array(items) => !items.iter().any(|i| i.is_array() || i.is_object()),
        Value::Object(map) => map.is_empty(),
        _ => true,
    }
}

fn is_nested(value: &Value) -> bool {
    !is_flat(value)
}

fn json_value(value: &Value, depth: usize, out: &mut String) {
    let line = |out: &mut String, depth: usize| {
        out.push('\n');
        out.extend(std::iter::repeat_n("  ", depth));
    };
    match value {
        Value::Array(items) if is_flat(value) => {
            let items: Vec<String> = items.iter().map(Value::to_string).collect();
            out.push_str(&format!("[{}]", items.join(", ")));
        }
        Value::Array(items) => {
            out.push('[');
            for (i, item) in items.iter().enumerate() {
                out.push_str(if i == 0 { "" } else { "," });
                line(out, depth + 1);
                json_value(item, depth + 1, out);
            }
            line(out, depth);
            out.push(']');
        }
        Value::Object(map) if !map.is_empty() => {
            out.push('{');
            for (i, (key, item)) in map.iter().enumerate() {
                out.push_str(if i == 0 { "" } else { "," });
                line(out, depth + 1);
                out.push_str(&format!("{}: ", Value::from(key.as_str())));
                json_value(item, depth + 1, out);
            }
            line(out, depth);
            out.push('}');
        }
        scalar => out.push_str(&scalar.to_string()),
    }
}

fn yaml_block(value: &Value, depth: usize, out: &mut String) {
    let entries: Vec<(String, &Value)> = match value {
        Value::Array(items) => items.iter().map(|item| ("-".to_owned(), item)).collect(),
        Value::Object(map) => {
            map.iter().map(|(key, item)| (format!("{}:", yaml_key(key)), item)).collect()
        }
        _ => Vec::new(),
    };
    for (lead, item) in entries {
        out.extend(std::iter::repeat_n("  ", depth));
        out.push_str(&lead);
        if is_nested(item) {
            out.push('\n');
            yaml_block(item, depth + 1, out);
        } else {
            out.push(' ');
            yaml_flow(item, out);
            out.push('\n');
        }
    }
}

fn yaml_flow(value: &Value, out: &mut String) {
    match value {
        Value::Array(items) => {
            out.push('[');
            for (i, item) in items.iter().enumerate() {
                out.push_str(if i == 0 { "" } else { ", " });
                yaml_flow(item, out);
            }
            out.push(']');
        }
        Value::Object(_) => out.push_str("{}"),
        Value::String(text) => out.push_str(&yaml_string(text)),
        Value::Number(number) => out.push_str(&yaml_number(number)),
        scalar => out.push_str(&scalar.to_string()),
    }
}

/// Keys of the format are plain; any other key is quoted.
fn yaml_key(key: &str) -> String {
    let plain = key.len() > 1
        && key.bytes().all(|b| b.is_ascii_alphabetic() || b == b'_')
        && !["no", "on", "off", "yes", "null", "true", "false"]
            .contains(&key.to_ascii_lowercase().as_str());
    if plain { key.to_owned() } else { yaml_string(key) }
}

/// Always in double quotes, which every reader interprets the same way.
fn yaml_string(text: &str) -> String {
    let mut out = String::from('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            '\0'..='\x1f' | '\x7f'..='\u{a0}' => out.push_str(&format!("\\x{:02x}", c as u32)),
            '\u{2028}' | '\u{2029}' | '\u{feff}' | '\u{fffe}' | '\u{ffff}' => {
                out.push_str(&format!("\\u{:04x}", c as u32));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// YAML 1.1 requires a decimal point before an exponent, and a sign in it: `1.0e-7`.
fn yaml_number(number: &Number) -> String {
    let text = number.to_string();
    let Some((mantissa, exponent)) = text.split_once(['e', 'E']) else {
        return text;
    };
    let point = if mantissa.contains('.') { "" } else { ".0" };
    let sign = if exponent.starts_with(['+', '-']) { "" } else { "+" };
    format!("{mantissa}{point}e{sign}{exponent}")
}
