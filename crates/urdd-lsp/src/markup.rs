//! The elements of an XML text that may be half typed. No text is refused: what is missing ends where the next thing
//! begins.

use std::borrow::Cow;
use std::ops::Range;

use urdd_xml::MAX_LEVELS;

/// The elements of a text, in the order in which they begin.
#[derive(Debug)]
pub struct Markup {
    pub elements: Vec<Element>,
}

impl Markup {
    pub fn new(text: &str) -> Self {
        Markup { elements: scan(text) }
    }

    pub fn name<'t>(&self, text: &'t str, element: usize) -> &'t str {
        &text[self.elements[element].name.clone()]
    }

    /// The name of the element that contains this one.
    pub fn parent_name<'t>(&self, text: &'t str, element: usize) -> Option<&'t str> {
        let parent = self.elements[element].parent?;
        Some(self.name(text, parent))
    }

    pub fn attribute(&self, text: &str, element: usize, name: &str) -> Option<&Attribute> {
        let mut attributes = self.elements[element].attributes.iter();
        attributes.find(|attribute| &text[attribute.name.clone()] == name)
    }

    /// The value of an attribute, with references such as `&amp;` replaced.
    pub fn value<'t>(&self, text: &'t str, element: usize, name: &str) -> Option<Cow<'t, str>> {
        let attribute = self.attribute(text, element, name)?;
        Some(unescaped(&text[attribute.value.clone()]))
    }

    /// The element and those that contain it, from the inside.
    pub fn ancestors(&self, element: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(element), |one| self.elements[*one].parent)
    }

    pub fn has_children(&self, element: usize) -> bool {
        let next = self.elements.get(element + 1);
        next.is_some_and(|next| next.parent == Some(element))
    }

    pub fn children(&self, element: usize) -> impl Iterator<Item = usize> {
        let end = self.elements[element].end;
        let inside = (element + 1..self.elements.len())
            .take_while(move |other| self.elements[*other].tag.start < end);
        inside.filter(move |other| self.elements[*other].parent == Some(element))
    }
}

/// An attribute's value as it is meant.
pub fn unescaped(value: &str) -> Cow<'_, str> {
    if !value.contains('&') {
        return Cow::Borrowed(value);
    }
    let mut plain = value.to_owned();
    for (escaped, c) in
        [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")]
    {
        plain = plain.replace(escaped, c);
    }
    Cow::Owned(plain)
}

/// A text as the value of an attribute.
pub fn escaped(value: &str) -> String {
    let value = value.replace('&', "&amp;").replace('<', "&lt;");
    value.replace('"', "&quot;").replace('\'', "&apos;")
}

/// What is at an offset of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// The name in a start tag.
    TagName {
        element: usize,
    },
    /// In an end tag, or where one is typed.
    EndTag {
        /// The element to close.
        element: usize,
    },
    /// The name of an attribute, or the blank where one is typed.
    AttributeName {
        element: usize,
        /// Index of the attribute; `None` at a blank.
        attribute: Option<usize>,
    },
    Value {
        element: usize,
        attribute: usize,
    },
    /// Between tags.
    Content {
        /// The innermost element.
        element: Option<usize>,
    },
}

impl Place {
    pub fn element(self) -> Option<usize> {
        match self {
            Place::TagName { element }
            | Place::EndTag { element }
            | Place::AttributeName { element, .. }
            | Place::Value { element, .. } => Some(element),
            Place::Content { element } => element,
        }
    }
}

impl Markup {
    pub fn place(&self, text: &str, offset: usize) -> Place {
        let after = self.elements.partition_point(|one| one.tag.start < offset);
        let Some(last) = after.checked_sub(1) else {
            return Place::Content { element: None };
        };
        let tag = &self.elements[last].tag;
        let is_unfinished = !self.elements[last].is_finished;
        // In an unfinished tag, one more blank still belongs to it.
        let blank = text.get(tag.end..offset.max(tag.end)).unwrap_or_default();
        let beyond = is_unfinished && blank.chars().all(|c| c == ' ');
        if offset < tag.end || (is_unfinished && offset == tag.end) || beyond {
            return self.in_tag(last, offset);
        }
        let before = text.get(tag.end..offset).unwrap_or_default();
        let end_tag = before.rfind('<').filter(|at| {
            let typed = &before[*at..];
            typed.starts_with("</") && !typed.contains('>')
        });
        // What an end tag closes is what it is in, though it ends with it.
        let within = end_tag.map_or(offset, |at| tag.end + at);
        let element = self.ancestors(last).find(|one| {
            let one = &self.elements[*one];
            let is_inside = within < one.end || within == text.len();
            one.tag.end <= within && one.tag.end < one.end && is_inside
        });
        match (end_tag, element) {
            (Some(_), Some(element)) => Place::EndTag { element },
            _ => Place::Content { element },
        }
    }

    fn in_tag(&self, element: usize, offset: usize) -> Place {
        let one = &self.elements[element];
        if offset <= one.name.end {
            return Place::TagName { element };
        }
        for (attribute, at) in one.attributes.iter().enumerate() {
            if at.name.start <= offset && offset <= at.name.end {
                let attribute = Some(attribute);
                return Place::AttributeName { element, attribute };
            }
            if at.value.start > at.name.end && at.value.start <= offset && offset <= at.value.end {
                return Place::Value { element, attribute };
            }
        }
        Place::AttributeName { element, attribute: None }
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Attribute {
    /// The bytes of its name.
    pub name: Range<usize>,
    /// The bytes of its value, without quotes; empty and behind the name if there is none.
    pub value: Range<usize>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Element {
    /// The bytes of its name; empty after a lone `<`.
    pub name: Range<usize>,
    /// From `<` to the end of the start tag.
    pub tag: Range<usize>,
    /// The end of the element, with its end tag.
    pub end: usize,
    pub attributes: Vec<Attribute>,
    pub parent: Option<usize>,
    /// Whether the start tag has its `>`.
    pub is_finished: bool,
}

/// Elements that contain others: one whose start tag is not finished still contains what follows.
const CONTAINERS: &str = "robot link joint visual collision inertial geometry material transmission gazebo \
    ros2_control actuator";

fn scan(text: &str) -> Vec<Element> {
    let mut scan = Scan { text, elements: Vec::new(), open: Vec::new() };
    let mut at = 0;
    while let Some(next) = text.get(at..).and_then(|rest| rest.find('<')) {
        at = scan.markup(at + next);
    }
    scan.close_to(0, text.len());
    scan.elements
}

struct Scan<'t> {
    text: &'t str,
    elements: Vec<Element>,
    /// The elements that are not closed.
    open: Vec<usize>,
}

impl Scan<'_> {
    /// Reads what begins with the `<` at `start`, and returns the offset behind it.
    fn markup(&mut self, start: usize) -> usize {
        let rest = &self.text[start..];
        for (begin, end) in [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>"), ("<!", ">")] {
            if let Some(inside) = rest.strip_prefix(begin) {
                let length = inside.find(end).map(|at| begin.len() + at + end.len());
                return start + length.unwrap_or(rest.len());
            }
        }
        match rest.strip_prefix("</") {
            Some(inside) => self.end_tag(start, inside),
            None => self.start_tag(start),
        }
    }

    fn end_tag(&mut self, start: usize, inside: &str) -> usize {
        let name = &inside[..name_length(inside)];
        let behind = start + 2 + name.len();
        let blank = self.text[behind..].len() - self.text[behind..].trim_start().len();
        let end =
            if self.text[behind + blank..].starts_with('>') { behind + blank + 1 } else { behind };
        let is_same = |open: &usize| &self.text[self.elements[*open].name.clone()] == name;
        if let Some(depth) = self.open.iter().rposition(is_same) {
            self.close_to(depth + 1, start);
            if let Some(closed) = self.open.pop() {
                self.elements[closed].end = end;
            }
        }
        end
    }

    /// Closes the elements from this depth on.
    fn close_to(&mut self, depth: usize, end: usize) {
        for open in self.open.drain(depth.min(self.open.len())..) {
            self.elements[open].end = end;
        }
    }

    fn start_tag(&mut self, start: usize) -> usize {
        let length = name_length(&self.text[start + 1..]);
        let name = start + 1..start + 1 + length;
        let mut at = name.end;
        let mut attributes = Vec::new();
        let (mut is_finished, mut is_empty) = (false, true);
        // A lone `<` has no attributes.
        while !name.is_empty() {
            let rest = &self.text[at..];
            let blank = rest.len() - rest.trim_start().len();
            let rest = rest.trim_start();
            if rest.is_empty() || rest.starts_with('<') {
                // Not finished: what follows is about something else.
                is_empty = !CONTAINERS.split(' ').any(|one| *one == self.text[name.clone()]);
                break;
            }
            at += blank;
            if rest.starts_with("/>") || rest.starts_with('>') {
                is_empty = rest.starts_with('/');
                is_finished = true;
                at += 1 + usize::from(is_empty);
                break;
            }
            at = self.attribute(at, &mut attributes);
        }
        self.leave_unfinished(&self.text[name.clone()]);
        self.elements.push(Element {
            name,
            tag: start..at,
            end: at,
            attributes,
            parent: self.open.last().copied(),
            is_finished,
        });
        // Deeper elements are read as empty: each tag is compared with all that are open.
        if !is_empty && self.open.len() < MAX_LEVELS {
            self.open.push(self.elements.len() - 1);
        }
        at
    }

    /// A link or joint of the robot ends the one before, which lacks its end tag.
    fn leave_unfinished(&mut self, name: &str) {
        if !matches!(name, "link" | "joint") {
            return;
        }
        let name_of = |open: &usize| &self.text[self.elements[*open].name.clone()];
        let names: Vec<&str> = self.open.iter().map(name_of).collect();
        let unclosed = names.iter().position(|open| matches!(*open, "link" | "joint"));
        // Within these, joints and links are mentioned.
        let mentions = |open: &&str| matches!(*open, "transmission" | "gazebo" | "ros2_control");
        if let Some(depth) = unclosed
            && !names.iter().any(mentions)
        {
            let start = self.text.len();
            let start = self.elements.last().map_or(start, |last| last.end);
            self.close_to(depth, start);
        }
    }

    /// Reads an attribute, and returns the offset behind it.
    fn attribute(&self, start: usize, attributes: &mut Vec<Attribute>) -> usize {
        let rest = &self.text[start..];
        let length = name_length(rest);
        if length == 0 {
            // A stray character.
            return start + rest.chars().next().map_or(1, char::len_utf8);
        }
        let name = start..start + length;
        let blank = |at: usize| self.text[at..].len() - self.text[at..].trim_start().len();
        let equals = name.end + blank(name.end);
        if !self.text[equals..].starts_with('=') {
            let value = name.end..name.end;
            attributes.push(Attribute { name, value });
            return start + length;
        }
        let begin = equals + 1 + blank(equals + 1);
        let rest = &self.text[begin..];
        let quote = rest.chars().next().filter(|c| matches!(c, '"' | '\''));
        let Some(quote) = quote else {
            // No quotes: up to the next blank.
            let value = equals + 1..equals + 1;
            attributes.push(Attribute { name, value });
            return equals + 1;
        };
        let inside = &rest[1..];
        let (length, behind) = match inside.find([quote, '<']) {
            Some(end) if inside[end..].starts_with(quote) => (end, 1),
            // The second quote is missing.
            end => {
                let inside = &inside[..end.unwrap_or(inside.len())];
                let cut = inside.find(['\n', '\r', '>']).unwrap_or(inside.len());
                (inside[..cut].trim_end_matches('/').len(), 0)
            }
        };
        let value = begin + 1..begin + 1 + length;
        let end = value.end + behind;
        attributes.push(Attribute { name, value });
        end
    }
}

/// The length of the name that a text begins with, bytes.
fn name_length(text: &str) -> usize {
    let ends = |c: char| c.is_whitespace() || matches!(c, '=' | '>' | '/' | '<' | '"' | '\'');
    text.find(ends).unwrap_or(text.len())
}
