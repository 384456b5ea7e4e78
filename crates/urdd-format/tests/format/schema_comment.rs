//! The comment of a schema in generated types: its description and annotations, wrapped.

use serde_json::Value;
use urdd_format::annotations;

/// The lines of the comment. None where the schema says nothing: the value of a kind of a choice, for example.
pub fn lines(schema: &Value, width: usize) -> Vec<String> {
    let description = schema["description"].as_str().unwrap_or_default();
    let texts = [description.to_owned(), annotations::sentence(schema)];
    let words = texts.into_iter().filter(|text| !text.is_empty());
    let words = words.collect::<Vec<_>>().join("\n\n");
    let mut lines = Vec::new();
    for line in words.lines() {
        let mut wrapped = String::new();
        for word in line.split(' ').filter(|word| !word.is_empty()) {
            if !wrapped.is_empty() && wrapped.chars().count() + 1 + word.chars().count() > width {
                lines.push(std::mem::take(&mut wrapped));
            }
            if !wrapped.is_empty() {
                wrapped.push(' ');
            }
            wrapped.push_str(word);
        }
        lines.push(wrapped);
    }
    lines
}
