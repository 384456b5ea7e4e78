//! Reads a YAML file of another program whose values are words: mappings, lists and strings, without tags and aliases.

use saphyr_parser::{Event, Marker, Parser, ScalarStyle};
use serde_json::{Map, Value};

use super::super::limits::DEPTH_LIMIT;

/// Why such a file cannot be read, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WordsFault {
    /// From 1.
    pub line: usize,
    /// From 1.
    pub column: usize,
    /// What is wrong.
    pub reason: String,
}

impl WordsFault {
    fn new(at: Marker, reason: impl Into<String>) -> Self {
        WordsFault { line: at.line(), column: at.col() + 1, reason: reason.into() }
    }
}

/// A list or mapping whose end has not come.
enum Open {
    List(Vec<Value>),
    /// With the key whose value comes next.
    Mapping(Map<String, Value>, Option<String>),
}

/// The one document of a file. Every scalar is a string, or null where it is empty or `null`.
///
/// # Errors
/// If it is not YAML, has a tag, an anchor, an alias, a key twice or one that is no string, or is nested too deep.
pub fn read(text: &str) -> Result<Value, WordsFault> {
    let mut parser = Parser::new_from_str(text);
    let mut open: Vec<Open> = Vec::new();
    let mut root = None;
    while let Some(next) = parser.next_event() {
        let (event, span) =
            next.map_err(|error| WordsFault::new(*error.marker(), error.info().to_owned()))?;
        let at = span.start;
        let done = match event {
            Event::Alias(_) => return Err(WordsFault::new(at, "aliases are not read here")),
            Event::Scalar(_, _, anchor, ref tag) if anchor != 0 || tag.is_some() => {
                return Err(WordsFault::new(at, "tags and anchors are not read here"));
            }
            Event::SequenceStart(anchor, ref tag) | Event::MappingStart(anchor, ref tag)
                if anchor != 0 || tag.is_some() =>
            {
                return Err(WordsFault::new(at, "tags and anchors are not read here"));
            }
            Event::SequenceStart(..) | Event::MappingStart(..) if open.len() >= DEPTH_LIMIT => {
                return Err(WordsFault::new(at, "it is nested too deep"));
            }
            Event::DocumentStart(_) if root.is_some() => {
                return Err(WordsFault::new(at, "a second document begins here"));
            }
            Event::SequenceStart(..) => {
                key_is_due(&open, at)?;
                open.push(Open::List(Vec::new()));
                continue;
            }
            Event::MappingStart(..) => {
                key_is_due(&open, at)?;
                open.push(Open::Mapping(Map::new(), None));
                continue;
            }
            Event::SequenceEnd | Event::MappingEnd => match open.pop() {
                Some(Open::List(list)) => Value::Array(list),
                Some(Open::Mapping(mapping, _)) => Value::Object(mapping),
                None => continue,
            },
            Event::Scalar(word, style, ..) => {
                let is_null = style == ScalarStyle::Plain && matches!(&*word, "" | "~" | "null");
                if let Some(Open::Mapping(mapping, key @ None)) = open.last_mut() {
                    if mapping.contains_key(&*word) {
                        return Err(WordsFault::new(at, "this key is there twice"));
                    }
                    *key = Some(word.into_owned());
                    continue;
                }
                if is_null { Value::Null } else { Value::String(word.into_owned()) }
            }
            _ => continue,
        };
        match open.last_mut() {
            None => root = Some(done),
            Some(Open::List(list)) => list.push(done),
            Some(Open::Mapping(mapping, key)) => {
                let Some(key) = key.take() else {
                    return Err(WordsFault::new(at, "this key is no string"));
                };
                mapping.insert(key, done);
            }
        }
    }
    Ok(root.unwrap_or(Value::Null))
}

/// A list or mapping cannot stand where a key is due.
fn key_is_due(open: &[Open], at: Marker) -> Result<(), WordsFault> {
    match open.last() {
        Some(Open::Mapping(_, None)) => Err(WordsFault::new(at, "this key is no string")),
        _ => Ok(()),
    }
}
