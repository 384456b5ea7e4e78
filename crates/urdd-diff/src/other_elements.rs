//! Elements that URDF does not define (transmission, gazebo, …): compared as XML, without white space between elements,
//! comments and the order of attributes.

use std::collections::HashMap;

use urdd_xml::element::{children, name, wrapped};
use urdd_xml::other_parts::{OtherParts, Owner};

use crate::fields::Fields;

/// The elements as parts: each with a name such as `transmission "t1"`, and with all its values. Equal names get a
/// number.
pub(super) fn parts(elements: &[String]) -> Vec<(String, Fields)> {
    numbered(elements.iter().map(|text| part(text)))
}

/// Gives a number to each part whose name one before it has.
pub(super) fn numbered(parts: impl Iterator<Item = (String, Fields)>) -> Vec<(String, Fields)> {
    let mut counts: HashMap<String, usize> = HashMap::new();
    let parts = parts.map(|(label, fields)| {
        let count = counts.entry(label.clone()).or_default();
        *count += 1;
        match count {
            1 => (label, fields),
            count => (format!("{label} ({count})"), fields),
        }
    });
    parts.collect()
}

/// Adds the elements to the values of a link or joint that contains them.
pub(super) fn add(elements: &[String], fields: &mut Fields) {
    for (label, part) in parts(elements) {
        fields.keyed(label, "", part.key(), part.summary());
    }
}

/// Adds what the URDF says of a link, a joint or the robot where URDF defines nothing.
pub(super) fn add_parts(parts: Option<&OtherParts>, owner: &Owner, fields: &mut Fields) {
    for part in parts.and_then(|parts| parts.get(owner)).into_iter().flatten() {
        let dot = if part.path.is_empty() { "" } else { "." };
        let at = format!("{}{dot}{}", part.path.replace('/', "."), part.name);
        let words: Vec<&str> = part.value.split_whitespace().collect();
        fields.text(at, Some(&words.join(" ")));
    }
}

/// The attribute that tells an element from others of its kind.
const NAMES: [&str; 3] = ["name", "reference", "joint"];

fn part(text: &str) -> (String, Fields) {
    let mut fields = Fields::default();
    let wrapped = wrapped(text);
    let parsed = urdd_xml::parse(&wrapped, urdd_xml::Kind::Other).ok();
    let root = parsed.as_ref().and_then(|document| document.root_element().first_element_child());
    let Some(root) = root else {
        let words: Vec<&str> = text.split_whitespace().collect();
        fields.text("text", Some(&words.join(" ")));
        return ("element".to_owned(), fields);
    };
    let mut label = name(root).to_owned();
    if let Some(value) = NAMES.iter().find_map(|key| root.attribute(*key)) {
        label = format!("{label} \"{value}\"");
    }
    // Depth is bounded by the parser; a stack keeps it off the call stack.
    let mut open = vec![(root, String::new())];
    while let Some((element, path)) = open.pop() {
        for attribute in element.attributes() {
            let at = match attribute.namespace() {
                None => format!("{path}{}", attribute.name()),
                Some(prefix) => format!("{path}{prefix}:{}", attribute.name()),
            };
            fields.text(at, Some(attribute.value()));
        }
        let texts = element.children().filter(|child| child.is_text());
        let words: Vec<&str> =
            texts.filter_map(|text| text.text()).flat_map(str::split_whitespace).collect();
        if !words.is_empty() {
            let at = match path.trim_end_matches('/') {
                "" => "text",
                at => at,
            };
            fields.text(at, Some(&words.join(" ")));
        }
        let mut counts: HashMap<&str, usize> = HashMap::new();
        for (tag, child) in children(element) {
            let count = counts.entry(tag).or_default();
            let below = match *count {
                0 => format!("{path}{tag}/"),
                count => format!("{path}{tag}[{count}]/"),
            };
            *count += 1;
            fields.text(below.clone(), Some(""));
            open.push((child, below));
        }
    }
    (label, fields.sorted())
}
