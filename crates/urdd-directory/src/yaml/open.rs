//! What YAML is compared with: the open lists and mappings, and the part of the JSON that a tagged node is. Messages about
//! a YAML mirror.

use std::borrow::Cow;
use std::collections::HashSet;

use saphyr_parser::{ScanError, Tag};
use serde_json::{Map, Value, map};

use crate::canonical::{self, yaml_quoted};
use crate::json_scan::push_segment;
use crate::position::{Position, TextFault, TextFaultKind};
use crate::yaml::scalar::{Reading, Readings};
use urdd_format::short::cut;

/// An open list or mapping.
pub struct Open<'j, 'y> {
    pub start: Position,
    /// Whether it is in flow style (brackets or braces).
    pub flow: bool,
    /// Name of the tag, if it replaces a key of the JSON.
    pub variant: Option<String>,
    pub shape: Shape<'j, 'y>,
}

pub enum Shape<'j, 'y> {
    List { json: Option<&'j [Value]>, begun: usize },
    Mapping(Mapping<'j, 'y>),
}

pub struct Mapping<'j, 'y> {
    json: Option<&'j Map<String, Value>>,
    /// Remaining members of the JSON, while the keys are in the same order.
    rest: Option<map::Iter<'j>>,
    in_order: usize,
    /// Keys so far, once the order differs from the JSON's.
    names: Option<HashSet<String>>,
    pub key: Option<Cow<'y, str>>,
    /// Set while a value is expected; the inner option is the JSON value, if known.
    pub due: Option<Option<&'j Value>>,
    pub merging: bool,
    /// Whether some keys come from merge keys or aliases, so that missing keys are not reported.
    pub incomplete: bool,
}

/// How a key relates to the JSON.
pub enum Member<'j> {
    Expected(&'j Value),
    Unknown,
    Extra,
    Repeated,
}

impl<'j, 'y> Mapping<'j, 'y> {
    pub fn new(json: Option<&'j Map<String, Value>>) -> Self {
        Self {
            json,
            rest: json.map(Map::iter),
            in_order: 0,
            names: None,
            key: None,
            due: None,
            merging: false,
            incomplete: false,
        }
    }

    /// Goes on behind a key whose members come from elsewhere.
    pub fn skip_key(&mut self) {
        self.key = None;
        self.due = Some(None);
        self.incomplete = true;
    }

    pub fn find(&mut self, name: &str) -> Member<'j> {
        if self.names.is_none()
            && let Some(rest) = &mut self.rest
        {
            let mut ahead = rest.clone();
            if let Some((key, value)) = ahead.next()
                && key == name
            {
                *rest = ahead;
                self.in_order += 1;
                return Member::Expected(value);
            }
        }
        let (json, in_order) = (self.json, self.in_order);
        let names = self.names.get_or_insert_with(|| {
            let before = json.into_iter().flat_map(Map::keys).take(in_order);
            before.cloned().collect()
        });
        if !names.insert(name.to_owned()) {
            return Member::Repeated;
        }
        match json.map(|map| map.get(name)) {
            Some(Some(value)) => Member::Expected(value),
            Some(None) => Member::Extra,
            None => Member::Unknown,
        }
    }

    pub fn missing(&self) -> impl Iterator<Item = (&'j str, &'j Value)> {
        let json = self.json.filter(|_| !self.incomplete);
        let skip = if self.names.is_none() { self.in_order } else { 0 };
        json.into_iter()
            .flat_map(Map::iter)
            .skip(skip)
            .filter(|(key, _)| !self.names.as_ref().is_some_and(|names| names.contains(*key)))
            .map(|(key, value)| (key.as_str(), value))
    }
}

/// JSON Pointer to the current node, in terms of the JSON document.
pub fn pointer(open: &[Open<'_, '_>]) -> String {
    let mut pointer = String::new();
    for open in open {
        if let Some(variant) = &open.variant {
            push_segment(&mut pointer, variant);
        }
        match &open.shape {
            Shape::List { begun, .. } => {
                push_segment(&mut pointer, &begun.saturating_sub(1).to_string());
            }
            Shape::Mapping(Mapping { key: Some(key), .. }) => push_segment(&mut pointer, key),
            Shape::Mapping(_) => {}
        }
    }
    pointer
}

/// What to compare a node with, given its tag.
pub struct Target<'j> {
    pub json: Option<&'j Value>,
    pub variant: Option<String>,
    /// How a tag forces a scalar to be read.
    pub forced: Option<Forced>,
}

#[derive(Clone, Copy)]
pub enum Forced {
    Text,
    Plain,
}

/// The kind of a tagged node.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Node {
    Empty,
    Scalar,
    List,
    Mapping,
}

/// Sets `target` to the part of the JSON that corresponds to the tagged node. Returns what to do instead of a tag.
pub fn apply_tag(tag: &Tag, node: Node, target: &mut Target<'_>) -> String {
    let name = tag.suffix.as_str();
    let inner = match target.json {
        Some(Value::Object(map)) if map.len() == 1 => map.get(name),
        _ => None,
    };
    let unit = node == Node::Empty && target.json.and_then(Value::as_str) == Some(name);
    if tag.is_yaml_core_schema() {
        target.forced = Some(if name == "str" { Forced::Text } else { Forced::Plain });
    } else if inner.is_some() {
        target.json = inner;
        target.variant = Some(name.to_owned());
    } else if name.is_empty() || name == "!" {
        target.forced = Some(Forced::Text);
    } else {
        // The tag itself is the difference; do not report a second one.
        target.json = target.json.filter(|json| match node {
            Node::List => json.is_array(),
            Node::Mapping => json.is_object(),
            Node::Empty | Node::Scalar => false,
        });
    }
    if target.variant.is_some() {
        format!("write `{name}:` as a key, with the value below it")
    } else if unit {
        format!("write `{name}` as a string")
    } else {
        "remove it".to_owned()
    }
}

pub fn tag_fault(tag: &Tag, instead: &str) -> TextFault {
    let name = tag.suffix.as_str();
    let written = if tag.is_yaml_core_schema() {
        format!("!!{name}")
    } else {
        format!("!{}", name.trim_start_matches('!'))
    };
    let written = excerpt(&written);
    let message = format!("`{written}` is a tag, which plain readers refuse: {instead}");
    TextFault::new(TextFaultKind::YamlTag, message).finding(written)
}

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
