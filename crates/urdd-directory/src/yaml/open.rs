//! The lists and mappings that are open while YAML is read in step with JSON.

use std::borrow::Cow;
use std::collections::HashSet;

use serde_json::{Map, Value, map};

use super::super::json_scan::push_segment;
use super::super::position::Position;

/// A list or mapping that has begun and not ended.
pub struct Open<'j, 'y> {
    pub start: Position,
    /// Whether it is written with brackets.
    pub flow: bool,
    /// The name of the tag that stands for a key which the JSON has.
    pub variant: Option<String>,
    pub shape: Shape<'j, 'y>,
}

pub enum Shape<'j, 'y> {
    List {
        json: Option<&'j [Value]>,
        begun: usize,
    },
    Mapping(Mapping<'j, 'y>),
}

pub struct Mapping<'j, 'y> {
    json: Option<&'j Map<String, Value>>,
    /// The JSON's members that are still to come, as long as the keys come in the same order.
    rest: Option<map::Iter<'j>>,
    in_order: usize,
    /// The keys so far, once they have left the JSON's order.
    names: Option<HashSet<String>>,
    pub key: Option<Cow<'y, str>>,
    /// Set while a value is due: what it should be, if that is known.
    pub due: Option<Option<&'j Value>>,
    pub merging: bool,
    /// Whether keys come from elsewhere (merge keys, aliases), so that absent ones mean nothing.
    pub incomplete: bool,
}

/// What the JSON has to say of a key.
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
        let skip = if self.names.is_none() {
            self.in_order
        } else {
            0
        };
        json.into_iter()
            .flat_map(Map::iter)
            .skip(skip)
            .filter(|(key, _)| {
                !self
                    .names
                    .as_ref()
                    .is_some_and(|names| names.contains(*key))
            })
            .map(|(key, value)| (key.as_str(), value))
    }
}

/// The pointer to the node that is being read, in terms of the JSON.
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
