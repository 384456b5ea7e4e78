//! Elements by the names that are written, and changes of a text that leave the rest of it as it is.

use std::ops::Range;

use roxmltree::{Attribute, Document, Node};

/// The name of an element, its prefix included, as it is written: `xacro:link` is no `link`, whatever
/// `xacro` stands for.
pub fn name<'a>(element: Node<'a, 'a>) -> &'a str {
    name_at(element.document(), &element.range())
}

/// The name of the element that stands at a place, as [`name`] gives it.
pub fn name_at<'a>(document: &'a Document<'a>, range: &Range<usize>) -> &'a str {
    let text = &document.input_text()[range.clone()];
    let start = text.strip_prefix('<').unwrap_or(text);
    start
        .split(|c: char| c.is_ascii_whitespace() || c == '>' || c == '/')
        .next()
        .unwrap_or_default()
}

/// The elements directly in an element, with their names.
pub fn children<'a>(parent: Node<'a, 'a>) -> impl Iterator<Item = (&'a str, Node<'a, 'a>)> {
    parent
        .children()
        .filter(Node::is_element)
        .map(|element| (name(element), element))
}

/// An attribute without prefix.
pub fn attribute<'a>(element: Node<'a, 'a>, name: &str) -> Option<Attribute<'a, 'a>> {
    element
        .attributes()
        .find(|attribute| attribute.name() == name && attribute.namespace().is_none())
}

/// A change of a text: the bytes of `range` become `text`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// Bytes of the text.
    pub range: Range<usize>,
    /// What stands there instead.
    pub text: String,
}

/// The text with its edits. Of two edits, one within the other, the outer one counts.
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
