//! Files of cases: reading them, and writing them as people do.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

/// A list or an object is on one line up to this column.
const WIDTH: usize = 100;

/// The folder of the suite.
pub fn suite() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance")
}

/// The files of cases in a folder of the suite, by code.
pub fn read(folder: &str) -> BTreeMap<String, Value> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(suite().join(folder)).into_iter().flatten() {
        let path = entry.expect("an entry").path();
        let code = path.file_stem().and_then(|name| name.to_str()).expect("a name").to_owned();
        let text = fs::read(&path).expect("a file");
        let file = serde_json::from_slice(&text);
        files.insert(code, file.unwrap_or_else(|error| panic!("{}: {error}", path.display())));
    }
    files
}

/// Codes whose files differ.
pub fn differences(
    before: &BTreeMap<String, Value>,
    after: &BTreeMap<String, Value>,
) -> BTreeSet<String> {
    let codes = before.keys().chain(after.keys());
    codes.filter(|code| before.get(*code) != after.get(*code)).cloned().collect()
}

/// Writes the files that differ into a folder of the suite.
pub fn write(folder: &str, before: &BTreeMap<String, Value>, after: &BTreeMap<String, Value>) {
    for code in differences(before, after) {
        let path = suite().join(folder).join(&code).with_extension("json");
        match after.get(&code) {
            Some(file) => fs::write(&path, text(file)).expect("written"),
            None => fs::remove_file(&path).expect("removed"),
        }
        println!("wrote conformance/{folder}/{code}.json");
    }
}

/// A file's text.
pub fn text(file: &Value) -> String {
    let mut text = String::new();
    lay_out(file, 0, 0, &mut text);
    text + "\n"
}

/// Appends a value. `before` is what stands before it on its line besides the indentation.
fn lay_out(value: &Value, indent: usize, before: usize, text: &mut String) {
    let line = one_line(value);
    let rows: Vec<(String, &Value)> = match value {
        Value::Object(object) => object
            .iter()
            .map(|(key, value)| (format!("{}: ", one_line(&key.as_str().into())), value))
            .collect(),
        Value::Array(list) => list.iter().map(|value| (String::new(), value)).collect(),
        _ => Vec::new(),
    };
    if rows.is_empty() || indent + before + line.chars().count() <= WIDTH {
        text.push_str(&line);
        return;
    }
    let [open, close] = if value.is_object() { ['{', '}'] } else { ['[', ']'] };
    let mut separator = open;
    for (key, value) in rows {
        *text += &format!("{separator}\n{:1$}{key}", "", indent + 2);
        // A comma may follow.
        lay_out(value, indent + 2, key.chars().count() + 1, text);
        separator = ',';
    }
    *text += &format!("\n{:indent$}{close}", "");
}

fn one_line(value: &Value) -> String {
    match value {
        Value::Object(object) => {
            let pair = |(key, value): (&String, &Value)| {
                format!("{}: {}", Value::from(key.as_str()), one_line(value))
            };
            format!("{{{}}}", object.iter().map(pair).collect::<Vec<_>>().join(", "))
        }
        Value::Array(list) => {
            format!("[{}]", list.iter().map(one_line).collect::<Vec<_>>().join(", "))
        }
        _ => value.to_string(),
    }
}
