//! YAML as a value: with the place of each part; or, of another program's file, with words alone as scalars.

use std::collections::HashMap;
use std::ops::Range;

use saphyr_parser::{Event, Marker, Parser, ScalarStyle, Span};
use serde_json::{Map, Number, Value};

use crate::json_scan::push_segment;
use crate::limits::DEPTH_LIMIT;
use crate::position::Offsets;
use crate::yaml::scalar::{Reading, classify};

/// Bytes of pointers for each byte of a text: long keys are in the pointers of all that is below them.
const MAX_POINTER_BYTES: usize = 32;

/// A document, and the place of each part.
pub struct Yaml {
    /// Its value, as YAML 1.2 reads it.
    pub value: Value,
    places: HashMap<String, Range<usize>>,
}

impl Yaml {
    /// The bytes of the value at a pointer, or of its key.
    pub fn range(&self, pointer: &str) -> Option<Range<usize>> {
        self.places.get(pointer).cloned()
    }

    /// The pointer of the innermost value, or of the key, at an offset.
    pub fn pointer_at(&self, offset: usize) -> Option<&str> {
        let around = self.places.iter();
        let around = around.filter(|(_, range)| range.start <= offset && offset <= range.end);
        let found = around.max_by_key(|(pointer, range)| (range.start, pointer.len()));
        found.map(|(pointer, _)| pointer.as_str())
    }
}

/// A list or an object whose end has not come.
enum Open {
    List(Vec<Value>),
    /// With the key whose value comes next.
    Object(Map<String, Value>, Option<String>),
}

/// Reads a document. `None` if it is not YAML, or has what JSON has not: anchors, keys that are not words; or if its keys
/// are longer than any real ones.
pub fn read(text: &str) -> Option<Yaml> {
    let mut reader = PlaceReader {
        offsets: Offsets::new(text),
        open: Vec::new(),
        pointer: String::new(),
        places: HashMap::new(),
        left: (text.len() + 1000) * MAX_POINTER_BYTES,
        value: None,
    };
    let mut parser = Parser::new_from_str(text);
    while let Some(event) = parser.next_event() {
        let (event, span) = event.ok()?;
        reader.event(event, span)?;
    }
    Some(Yaml { value: reader.value?, places: reader.places })
}

struct PlaceReader<'t> {
    offsets: Offsets<'t>,
    open: Vec<Open>,
    /// The pointer of the next value.
    pointer: String,
    places: HashMap<String, Range<usize>>,
    /// The number of bytes that pointers may still have.
    left: usize,
    value: Option<Value>,
}

impl PlaceReader<'_> {
    fn event(&mut self, event: Event, span: Span) -> Option<()> {
        let start = self.offsets.bytes(span.start.index());
        match event {
            Event::Alias(_) => return None,
            Event::SequenceStart(..) => {
                self.begin(start)?;
                self.open.push(Open::List(Vec::new()));
                self.pointer.push_str("/0");
            }
            Event::MappingStart(..) => {
                self.begin(start)?;
                self.open.push(Open::Object(Map::new(), None));
            }
            Event::SequenceEnd => {
                self.leave();
                let Open::List(list) = self.open.pop()? else {
                    return None;
                };
                self.put(Value::Array(list))?;
            }
            Event::MappingEnd => {
                let Open::Object(object, None) = self.open.pop()? else {
                    return None;
                };
                self.put(Value::Object(object))?;
            }
            Event::Scalar(text, style, ..) => {
                let end = self.offsets.bytes(span.end.index());
                if let Some(Open::Object(_, key @ None)) = self.open.last_mut() {
                    *key = Some(text.clone().into_owned());
                    push_segment(&mut self.pointer, &text);
                    self.left = self.left.checked_sub(self.pointer.len())?;
                    self.places.insert(self.pointer.clone(), start..end);
                    return Some(());
                }
                self.place(start, end)?;
                let is_plain = style == ScalarStyle::Plain;
                self.put(scalar(&text, is_plain)?)?;
            }
            _ => {}
        }
        Some(())
    }

    /// The value at the pointer begins.
    fn begin(&mut self, start: usize) -> Option<()> {
        if is_key_due(&self.open) || self.open.len() >= DEPTH_LIMIT {
            return None;
        }
        self.place(start, start)
    }

    /// The place of the value at the pointer. A member's goes from its key to its value, if that is a scalar.
    fn place(&mut self, start: usize, end: usize) -> Option<()> {
        self.left = self.left.checked_sub(self.pointer.len())?;
        let place = self.places.entry(self.pointer.clone()).or_insert(start..end);
        place.end = place.end.max(end);
        Some(())
    }

    fn leave(&mut self) {
        let end = self.pointer.rfind('/').unwrap_or_default();
        self.pointer.truncate(end);
    }

    /// The value at the pointer has ended.
    fn put(&mut self, value: Value) -> Option<()> {
        match self.open.last_mut() {
            None => self.value = Some(value),
            Some(Open::List(list)) => {
                list.push(value);
                let next = list.len();
                self.leave();
                push_segment(&mut self.pointer, &next.to_string());
            }
            Some(Open::Object(object, key)) => {
                object.insert(key.take()?, value);
                self.leave();
            }
        }
        Some(())
    }
}

fn scalar(text: &str, is_plain: bool) -> Option<Value> {
    if !is_plain {
        return Some(Value::String(text.to_owned()));
    }
    let number = || serde_json::from_str::<Number>(text).ok();
    Some(match classify(text).yaml12 {
        Reading::Null => Value::Null,
        Reading::Bool(value) => Value::Bool(value),
        Reading::Integer | Reading::Float => match number() {
            Some(number) => Value::Number(number),
            None => Value::Number(Number::from_f64(text.parse().ok()?)?),
        },
        Reading::NonFinite => return None,
        Reading::Text | Reading::Timestamp | Reading::Special => Value::String(text.to_owned()),
    })
}

/// Why a file of another program cannot be read, and where.
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
    pub(super) fn new(at: Marker, reason: impl Into<String>) -> Self {
        WordsFault { line: at.line(), column: at.col() + 1, reason: reason.into() }
    }
}

/// The document of another program's file: a mapping, mostly.
#[derive(Debug, Default)]
pub struct Words {
    /// Its value.
    pub value: Value,
    /// For each key of the outermost mapping, where it is, and where the scalars in its value are, in their order: byte
    /// offsets.
    places: HashMap<String, Vec<usize>>,
}

impl Words {
    /// The place of a key of the outermost mapping, byte offset.
    pub fn key(&self, key: &str) -> Option<usize> {
        self.places.get(key)?.first().copied()
    }

    /// The place of a scalar in the value of such a key, by its number there.
    pub fn scalar(&self, key: &str, number: usize) -> Option<usize> {
        self.places.get(key)?.get(number + 1).copied()
    }
}

/// The one document of a file. Every scalar is a string, or null where it is empty or `null`.
///
/// # Errors
/// If it is not YAML, has a tag, an anchor, an alias, a key twice or one that is no string, or is nested too deep.
pub fn read_words(text: &str) -> Result<Words, WordsFault> {
    let mut parser = Parser::new_from_str(text);
    let mut offsets = Offsets::new(text);
    let mut open: Vec<Open> = Vec::new();
    let mut root = None;
    let mut places: HashMap<String, Vec<usize>> = HashMap::new();
    // The key of the outermost mapping that was read last.
    let (mut outermost, mut own) = (String::new(), Vec::new());
    while let Some(next) = parser.next_event() {
        let (event, span) =
            next.map_err(|error| WordsFault::new(*error.marker(), error.info().to_owned()))?;
        let at = span.start;
        let done = match event {
            Event::Alias(_) => return Err(WordsFault::new(at, "aliases are not read here")),
            Event::Scalar(_, _, anchor, ref tag)
            | Event::SequenceStart(anchor, ref tag)
            | Event::MappingStart(anchor, ref tag)
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
            Event::SequenceStart(..) | Event::MappingStart(..) if is_key_due(&open) => {
                return Err(WordsFault::new(at, "this key is no string"));
            }
            Event::SequenceStart(..) => {
                open.push(Open::List(Vec::new()));
                continue;
            }
            Event::MappingStart(..) => {
                open.push(Open::Object(Map::new(), None));
                continue;
            }
            Event::SequenceEnd | Event::MappingEnd => match open.pop() {
                Some(Open::List(list)) => Value::Array(list),
                Some(Open::Object(mapping, _)) => Value::Object(mapping),
                None => continue,
            },
            Event::Scalar(word, style, ..) => {
                let is_null = style == ScalarStyle::Plain && matches!(&*word, "" | "~" | "null");
                if let [Open::Object(_, None)] = &open[..] {
                    let before = std::mem::replace(&mut outermost, word.to_string());
                    places.insert(before, std::mem::take(&mut own));
                }
                own.push(offsets.bytes(at.index()));
                if let Some(Open::Object(mapping, key @ None)) = open.last_mut() {
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
            Some(Open::Object(mapping, key)) => {
                if let Some(key) = key.take() {
                    mapping.insert(key, done);
                }
            }
        }
    }
    places.insert(outermost, own);
    Ok(Words { value: root.unwrap_or(Value::Null), places })
}

/// Whether a key is due, where no list or mapping can stand.
fn is_key_due(open: &[Open]) -> bool {
    matches!(open.last(), Some(Open::Object(_, None)))
}
