//! What can be written at the cursor.

use std::collections::HashSet;
use std::ops::Range;

use lsp_types::{CompletionItem, CompletionItemKind, CompletionTextEdit, Position, TextEdit};

use crate::document::Snapshot;
use crate::markup::{Place, escaped};
use crate::reference::{Names, names};
use urdd_format::loops::LoopKind;
use urdd_format::urdf::JointType;
use urdd_lint::vocabulary::of;

pub fn completion(snapshot: &Snapshot, at: Position) -> Vec<CompletionItem> {
    if !snapshot.kind.is_xml() || snapshot.is_too_large() {
        return Vec::new();
    }
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    let offset = snapshot.text.offset(at);
    match markup.place(text, offset) {
        Place::Value { element, attribute } => {
            let Some(attribute) = markup.elements[element].attributes.get(attribute) else {
                return Vec::new();
            };
            let range = replaced(snapshot, attribute.value.clone(), offset);
            let name = &text[attribute.name.clone()];
            values(snapshot, element, name)
                .into_iter()
                .map(|(value, kind, detail)| {
                    item(snapshot, &range, &value, escaped(&value), kind, detail)
                })
                .collect()
        }
        Place::TagName { element } => {
            let parent = markup.parent_name(text, element);
            let words = match parent {
                None => &["robot"][..],
                Some(parent) => {
                    let around = markup.elements[element].parent;
                    let around = around.and_then(|parent| markup.parent_name(text, parent));
                    known(around.unwrap_or_default(), parent)[1]
                }
            };
            let range = markup.elements[element].name.clone();
            let item = |word: &&str| {
                item(snapshot, &range, word, (*word).to_owned(), CompletionItemKind::CLASS, None)
            };
            words.iter().map(item).collect()
        }
        Place::AttributeName { element, attribute } => {
            attributes(snapshot, element, attribute, offset)
        }
        Place::EndTag { element } => {
            let name = markup.name(text, element).to_owned();
            let start = text[..offset].rfind("</").map_or(offset, |at| at + 2);
            let new = format!("{name}>");
            vec![item(snapshot, &(start..offset), &name, new, CompletionItemKind::CLASS, None)]
        }
        Place::Content { .. } => Vec::new(),
    }
}

/// What is replaced of a value. Editors take only what is on the cursor's line.
fn replaced(snapshot: &Snapshot, value: Range<usize>, offset: usize) -> Range<usize> {
    let end = value.end.min(snapshot.text.line_end(offset)).max(offset);
    value.start..end
}

fn item(
    snapshot: &Snapshot,
    range: &Range<usize>,
    label: &str,
    new_text: String,
    kind: CompletionItemKind,
    detail: Option<String>,
) -> CompletionItem {
    CompletionItem {
        label: label.to_owned(),
        kind: Some(kind),
        detail,
        text_edit: Some(CompletionTextEdit::Edit(TextEdit {
            range: snapshot.text.range(range.clone()),
            new_text,
        })),
        ..CompletionItem::default()
    }
}

type Value = (String, CompletionItemKind, Option<String>);

fn values(snapshot: &Snapshot, element: usize, attribute: &str) -> Vec<Value> {
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    let outline = snapshot.outline();
    let links = || {
        let links = outline.links.iter();
        links.map(|link| (link.name.clone(), CompletionItemKind::VARIABLE, Some("link".to_owned())))
    };
    let joints = || {
        let joints = outline.joints.iter();
        joints.map(|joint| {
            let detail = format!("joint: {} → {}", joint.parent, joint.child);
            (joint.name.clone(), CompletionItemKind::FUNCTION, Some(detail))
        })
    };
    let parent = markup.parent_name(text, element).unwrap_or_default();
    let name = markup.name(text, element);
    if (name, attribute) == ("joint", "type") {
        let types = JointType::ALL.iter().map(|kind| kind.as_str().to_lowercase());
        return types.map(|word| (word, CompletionItemKind::ENUM_MEMBER, None)).collect();
    }
    if (name, attribute) == ("loop", "type") {
        let kinds = LoopKind::ALL.iter().map(|kind| kind.as_str().to_lowercase());
        return kinds.map(|word| (word, CompletionItemKind::ENUM_MEMBER, None)).collect();
    }
    // What gives a name does not take one that is there.
    let is_definition = match name {
        "link" => true,
        "joint" => !matches!(parent, "transmission" | "ros2_control"),
        "material" => parent == "robot",
        _ => false,
    };
    let mut seen = HashSet::new();
    let found: Vec<Value> = match names(text, markup, element, attribute) {
        _ if is_definition => Vec::new(),
        Some(Names::Links) => links().collect(),
        Some(Names::Joints) => {
            // A joint does not follow itself.
            let own = markup.elements[element].parent.filter(|_| name == "mimic");
            let own = own.and_then(|own| markup.value(text, own, "name"));
            joints().filter(|(name, ..)| Some(name.as_str()) != own.as_deref()).collect()
        }
        Some(Names::Both) => links().chain(joints()).collect(),
        Some(Names::Materials) => {
            let materials = outline.materials.iter();
            materials.map(|one| (one.name.clone(), CompletionItemKind::COLOR, None)).collect()
        }
        Some(Names::Meshes) | None => Vec::new(),
    };
    found.into_iter().filter(|(name, ..)| !name.is_empty() && seen.insert(name.clone())).collect()
}

/// The attributes that an element can have and has not.
fn attributes(
    snapshot: &Snapshot,
    element: usize,
    at: Option<usize>,
    offset: usize,
) -> Vec<CompletionItem> {
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    let one = &markup.elements[element];
    let parent = markup.parent_name(text, element).unwrap_or_default();
    let current = at.and_then(|at| one.attributes.get(at));
    let range = current.map_or(offset..offset, |attribute| attribute.name.clone());
    // The name alone, if it has a value.
    let has_value = current.is_some_and(|attribute| attribute.value.start > attribute.name.end);
    let written: HashSet<&str> = one
        .attributes
        .iter()
        .filter(|attribute| current != Some(attribute))
        .map(|attribute| &text[attribute.name.clone()])
        .collect();
    let name = markup.name(text, element);
    // A declaration that only xacro needs.
    let xacro = (name == "robot").then_some("xmlns:xacro");
    let [attributes, _] = known(parent, name);
    let free = attributes.iter().copied().chain(xacro).filter(|name| !written.contains(name));
    free.map(|name| {
        let new = if has_value { name.to_owned() } else { format!("{name}=\"\"") };
        item(snapshot, &range, name, new, CompletionItemKind::PROPERTY, None)
    })
    .collect()
}

/// An element: where it is, its name, its attributes, and what it contains.
type Word = (&'static str, &'static str, &'static [&'static str], &'static [&'static str]);

/// Elements that other programs read: `urdd lint` leaves their content to these.
const WORDS: &[Word] = &[
    ("robot", "gazebo", &["reference"], &[]),
    ("robot", "transmission", &["name"], &["type", "joint", "actuator"]),
    ("transmission", "joint", &["name"], &["hardwareInterface"]),
    ("transmission", "actuator", &["name"], &["hardwareInterface", "mechanicalReduction"]),
    ("robot", "ros2_control", &["name", "type"], &["hardware", "joint", "sensor", "gpio"]),
    ("ros2_control", "joint", &["name"], &["command_interface", "state_interface", "param"]),
    ("robot", "loop", &["name", "type"], &["predecessor", "successor", "axis"]),
    ("loop", "predecessor", &["link"], &["origin"]),
    ("loop", "successor", &["link"], &["origin"]),
    ("robot", "coupling", &["name"], &["predecessor", "successor", "ratio"]),
    ("coupling", "predecessor", &["link"], &[]),
    ("coupling", "successor", &["link"], &[]),
    ("coupling", "ratio", &["value"], &[]),
];

/// The attributes of an element in another one, and what it contains.
fn known(parent: &str, name: &str) -> [&'static [&'static str]; 2] {
    match WORDS.iter().find(|word| (word.0, word.1) == (parent, name)) {
        Some((_, _, attributes, children)) => [attributes, children],
        None => of(name).map_or([&[], &[]], |known| [known.attributes, known.children]),
    }
}
