//! What YAML is compared with: the open lists and mappings, and the part of the JSON that a tagged node is.

use std::borrow::Cow;
use std::collections::HashSet;

use saphyr_parser::Tag;
use serde_json::{Map, Value, map};

use super::super::json_scan::push_segment;
use super::super::position::Position;
use super::super::text_fault::{TextFault, TextFaultKind};
use super::message::excerpt;

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

/// The replacement for a tag.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Instead {
    Key,
    String,
    Nothing,
}

/// Sets `target` to the part of the JSON that corresponds to the tagged node.
pub fn apply_tag(tag: &Tag, node: Node, target: &mut Target<'_>) -> Instead {
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
        Instead::Key
    } else if unit {
        Instead::String
    } else {
        Instead::Nothing
    }
}

/// The fault for a tag.
pub fn tag_fault(tag: &Tag, instead: Instead) -> TextFault {
    let name = tag.suffix.as_str();
    let written = if tag.is_yaml_core_schema() {
        format!("!!{name}")
    } else {
        format!("!{}", name.trim_start_matches('!'))
    };
    let instead = match instead {
        Instead::String => format!("write `{name}` as a string"),
        Instead::Key => format!("write `{name}:` as a key, with the value below it"),
        Instead::Nothing => "remove it".to_owned(),
    };
    let written = excerpt(&written);
    let message = format!("`{written}` is a tag, which plain readers refuse: {instead}");
    TextFault::new(TextFaultKind::YamlTag, message).finding(written)
}
