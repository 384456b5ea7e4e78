//! Compares a document with the URDF.

use std::collections::HashMap;

use serde_json::Value;

use crate::tolerance::{number_tolerance, numbers_agree};

/// A value that differs from the URDF.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// JSON Pointer in the document.
    pub pointer: String,
    /// JSON Pointer of the value in the URDF's data, which has other indices if elements are missing or moved.
    pub source: String,
    /// The URDF's value.
    pub expected: Value,
    /// The document's value.
    pub actual: Value,
    /// Tolerance, if both are numbers.
    pub tolerance: Option<f64>,
    /// How whole lists differ, if they do.
    pub list: Option<String>,
}

/// Every difference between the URDF's data and a document. Links and joints are compared by name, so that a missing
/// one is a single difference.
pub fn differences(expected: &Value, actual: &Value) -> Vec<Difference> {
    let mut comparison = Comparison::default();
    if let Some(keys) = expected.as_object() {
        for (key, expected) in keys {
            let actual = actual.get(key).unwrap_or(&Value::Null);
            let pointer = format!("/{key}");
            match (key.as_str(), expected, actual) {
                ("links" | "joints", Value::Array(expected), Value::Array(actual)) => {
                    comparison.by_name(&pointer, expected, actual);
                }
                _ => comparison.value(&pointer, &pointer, expected, actual),
            }
        }
    }
    comparison.found
}

#[derive(Default)]
struct Comparison {
    found: Vec<Difference>,
}

impl Difference {
    fn new(pointer: &str, source: &str, expected: &Value, actual: &Value) -> Self {
        Difference {
            pointer: pointer.to_owned(),
            source: source.to_owned(),
            expected: expected.clone(),
            actual: actual.clone(),
            tolerance: None,
            list: None,
        }
    }

    /// Two lists of these lengths.
    fn of_lists(pointer: &str, source: &str, lengths: [usize; 2], how: String) -> Self {
        let [expected, actual] = lengths.map(Value::from);
        Difference { list: Some(how), ..Difference::new(pointer, source, &expected, &actual) }
    }
}

impl Comparison {
    fn report(&mut self, pointer: &str, source: &str, expected: &Value, actual: &Value) {
        self.found.push(Difference::new(pointer, source, expected, actual));
    }

    fn value(&mut self, pointer: &str, source: &str, expected: &Value, actual: &Value) {
        match (expected, actual) {
            (Value::Object(wanted), Value::Object(there)) => {
                // A choice of one key: another key means another kind of value.
                if wanted.keys().any(|key| !there.contains_key(key)) {
                    self.report(pointer, source, expected, actual);
                    return;
                }
                for (key, expected) in wanted {
                    let actual = there.get(key).unwrap_or(&Value::Null);
                    let (pointer, source) = (format!("{pointer}/{key}"), format!("{source}/{key}"));
                    self.value(&pointer, &source, expected, actual);
                }
            }
            (Value::Array(wanted), Value::Array(there)) => {
                if wanted.len() != there.len() {
                    let how = format!("{} there, {} here", wanted.len(), there.len());
                    let lengths = [wanted.len(), there.len()];
                    self.found.push(Difference::of_lists(pointer, source, lengths, how));
                    return;
                }
                for (index, (expected, actual)) in wanted.iter().zip(there).enumerate() {
                    let (pointer, source) =
                        (format!("{pointer}/{index}"), format!("{source}/{index}"));
                    self.value(&pointer, &source, expected, actual);
                }
            }
            (Value::Number(wanted), Value::Number(there)) => {
                let (Some(a), Some(b)) = (wanted.as_f64(), there.as_f64()) else { return };
                if !numbers_agree(a, b) {
                    self.found.push(Difference {
                        tolerance: Some(number_tolerance(a, b)),
                        ..Difference::new(pointer, source, expected, actual)
                    });
                }
            }
            (Value::String(wanted), Value::String(there)) => {
                if wanted != there && unix_lines(wanted) != unix_lines(there) {
                    self.report(pointer, source, expected, actual);
                }
            }
            _ if expected == actual => {}
            _ => self.report(pointer, source, expected, actual),
        }
    }

    /// Compares lists of named elements: the same names in the same order, and each with its counterpart.
    fn by_name(&mut self, list: &str, expected: &[Value], actual: &[Value]) {
        let name = |value: &Value| -> String {
            let name = value.get("name").and_then(Value::as_str);
            name.unwrap_or_default().to_owned()
        };
        let wanted: Vec<String> = expected.iter().map(name).collect();
        let there: Vec<String> = actual.iter().map(name).collect();
        let others = wanted.iter().zip(&there).filter(|(wanted, there)| wanted != there).count();
        // An element with another name is compared too: the name is a difference.
        if wanted.len() == there.len() && others <= 1 {
            for (index, (expected, actual)) in expected.iter().zip(actual).enumerate() {
                let pointer = format!("{list}/{index}");
                self.value(&pointer, &pointer, expected, actual);
            }
            return;
        }
        let how = how_names_differ(&wanted, &there);
        self.found.push(Difference::of_lists(list, list, [wanted.len(), there.len()], how));
        let mut place: HashMap<&str, usize> = HashMap::new();
        for (index, name) in there.iter().enumerate() {
            place.entry(name).or_insert(index);
        }
        for (index, (name, expected)) in wanted.iter().zip(expected).enumerate() {
            if let Some(&at) = place.get(name.as_str()) {
                let (pointer, source) = (format!("{list}/{at}"), format!("{list}/{index}"));
                self.value(&pointer, &source, expected, &actual[at]);
            }
        }
    }
}

fn how_names_differ(wanted: &[String], there: &[String]) -> String {
    let only_in = |a: &[String], b: &[String]| {
        let b: std::collections::HashSet<&String> = b.iter().collect();
        let only: Vec<String> = a.iter().filter(|name| !b.contains(name)).cloned().collect();
        only
    };
    let (missing, extra) = (only_in(wanted, there), only_in(there, wanted));
    let mut words = Vec::new();
    if !missing.is_empty() {
        words.push(format!("missing: {}", first_names(&missing)));
    }
    if !extra.is_empty() {
        words.push(format!("not in the URDF: {}", first_names(&extra)));
    }
    if words.is_empty() {
        let first = wanted.iter().zip(there).find(|(a, b)| a != b);
        words.push(match first {
            Some((wanted, there)) => {
                format!("the order differs: `{there}` is where the URDF has `{wanted}`")
            }
            None => format!("{} there, {} here", wanted.len(), there.len()),
        });
    }
    words.join("; ")
}

/// The first few of a list of names.
pub fn first_names<S: AsRef<str>>(names: &[S]) -> String {
    const SHOWN: usize = 5;
    let mut text: Vec<String> =
        names.iter().take(SHOWN).map(|name| format!("`{}`", name.as_ref())).collect();
    if names.len() > SHOWN {
        text.push(format!("and {} more", names.len() - SHOWN));
    }
    text.join(", ")
}

/// A text with line endings as XML readers normalise them: copying files may have changed them.
fn unix_lines(text: &str) -> String {
    text.replace("\r\n", "\n")
}
