//! Tags: what to compare the tagged value with, and what to write instead of the tag.

use saphyr_parser::Tag;
use serde_json::Value;

use super::super::text_fault::{TextFault, TextFaultKind};
use super::message::excerpt;

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
pub fn apply(tag: &Tag, node: Node, target: &mut Target<'_>) -> Instead {
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
pub fn fault(tag: &Tag, instead: Instead) -> TextFault {
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
