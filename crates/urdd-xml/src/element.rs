//! Elements by their qualified names, and text edits that leave the rest of a document unchanged.

use std::ops::Range;

use roxmltree::{Attribute, Node};

use crate::MAX_PREFIXES;

/// The qualified name of an element, including its prefix: `xacro:link` is not `link`, whatever namespace `xacro` has.
pub fn name<'a>(element: Node<'a, 'a>) -> &'a str {
    name_at(element.document().input_text(), &element.range())
}

/// The qualified name of the element at a range of a text, as from [`name`].
pub fn name_at<'a>(text: &'a str, range: &Range<usize>) -> &'a str {
    let text = &text[range.clone()];
    let start = text.strip_prefix('<').unwrap_or(text);
    start
        .split(|c: char| c.is_ascii_whitespace() || c == '>' || c == '/')
        .next()
        .unwrap_or_default()
}

/// The child elements, with their names.
pub fn children<'a>(parent: Node<'a, 'a>) -> impl Iterator<Item = (&'a str, Node<'a, 'a>)> {
    parent.children().filter(Node::is_element).map(|element| (name(element), element))
}

/// An attribute without a prefix, by name.
pub fn attribute<'a>(element: Node<'a, 'a>, name: &str) -> Option<Attribute<'a, 'a>> {
    element
        .attributes()
        .find(|attribute| attribute.name() == name && attribute.namespace().is_none())
}

/// A text edit: replaces the bytes of `range` by `text`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// Byte range to replace.
    pub range: Range<usize>,
    /// The replacement.
    pub text: String,
}

impl Edit {
    /// Where the byte at an offset is after this edit; for one that it replaces, the beginning of the replacement.
    pub fn moved(&self, offset: usize) -> usize {
        match offset.checked_sub(self.range.end) {
            Some(behind) => self.range.start + self.text.len() + behind,
            None => offset.min(self.range.start),
        }
    }
}

/// Applies edits to a text. If one edit is inside another, only the outer one applies.
pub fn apply(text: &str, mut edits: Vec<Edit>) -> String {
    edits.sort_by_key(|edit| (edit.range.start, std::cmp::Reverse(edit.range.end)));
    let mut edited = String::with_capacity(text.len());
    let mut done = 0;
    for edit in edits {
        if edit.range.start < done {
            continue;
        }
        edited.push_str(&text[done..edit.range.start]);
        edited.push_str(&edit.text);
        done = edit.range.end;
    }
    edited.push_str(&text[done..]);
    edited
}

/// The element in one that declares every prefix that it may use: the robot's declarations are not in its text.
pub fn wrapped(text: &str) -> String {
    let mut prefixes: Vec<&str> = Vec::new();
    for (at, _) in text.match_indices(':') {
        let before = &text[..at];
        let word = before.rsplit(|c: char| c.is_whitespace() || "<>/\"'=&;:".contains(c));
        let prefix = word.into_iter().next().unwrap_or_default();
        let begins = prefix.starts_with(|c: char| c.is_alphabetic() || c == '_');
        let is_name = prefix.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.'));
        let is_reserved = prefix.to_ascii_lowercase().starts_with("xml");
        if begins && is_name && !is_reserved && !prefixes.contains(&prefix) {
            prefixes.push(prefix);
        }
        if prefixes.len() == MAX_PREFIXES - 1 {
            break;
        }
    }
    let declared: Vec<String> =
        prefixes.iter().map(|prefix| format!(" xmlns:{prefix}=\"{prefix}\"")).collect();
    format!("<x{}>{text}</x>", declared.concat())
}
