//! An XML tree and its serialization.

use std::borrow::Cow;

use crate::element::name;
use crate::number::number;
use quick_xml::escape::escape;
use roxmltree::{Attribute, Node};

use urdd_format::escape::is_hidden;

/// An element.
#[derive(Debug, Clone, Default)]
pub struct Element {
    name: Cow<'static, str>,
    attributes: Vec<(Cow<'static, str>, String)>,
    children: Vec<Child>,
}

#[derive(Debug, Clone)]
enum Child {
    Element(Element),
    /// Raw XML text.
    Raw(String),
    /// Characters.
    Text(String),
}

impl Element {
    /// An empty element.
    pub fn new(name: &'static str) -> Self {
        Element { name: name.into(), ..Element::default() }
    }

    /// An element of another document, without comments.
    pub fn of(node: Node) -> Self {
        let text = node.document().input_text();
        let attribute =
            |of: Attribute| (text[of.range_qname()].to_owned().into(), of.value().to_owned());
        let child = |child: Node| match child.text() {
            _ if child.is_element() => Some(Child::Element(Element::of(child))),
            Some(text) if child.is_text() && !text.trim().is_empty() => {
                Some(Child::Text(text.to_owned()))
            }
            _ => None,
        };
        Element {
            name: name(node).to_owned().into(),
            attributes: node.attributes().map(attribute).collect(),
            children: node.children().filter_map(child).collect(),
        }
    }

    /// Its qualified name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The value of an attribute.
    pub fn attribute(&self, key: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|(name, _)| name == key);
        found.map(|(_, value)| value.as_str())
    }

    /// The characters that it contains, without white space around them.
    pub fn own_text(&self) -> &str {
        match &self.children[..] {
            [Child::Text(text)] => text.trim(),
            _ => "",
        }
    }

    /// Its child elements.
    pub fn elements(&self) -> impl Iterator<Item = &Element> {
        self.children.iter().filter_map(|child| match child {
            Child::Element(element) => Some(element),
            _ => None,
        })
    }

    /// Its child elements, to be changed.
    pub fn elements_mut(&mut self) -> impl Iterator<Item = &mut Element> {
        self.children.iter_mut().filter_map(|child| match child {
            Child::Element(element) => Some(element),
            _ => None,
        })
    }

    /// Whether a name in it has a prefix, which another document need not declare.
    pub fn has_prefix(&self) -> bool {
        let mut names = self.attributes.iter().map(|(name, _)| name).chain([&self.name]);
        names.any(|name| name.contains(':')) || self.elements().any(Element::has_prefix)
    }

    /// The first child element of a name.
    pub fn child_mut(&mut self, name: &str) -> Option<&mut Element> {
        self.elements_mut().find(|element| element.name == name)
    }

    /// Replaces all that the child element at a path contains by characters. Elements that are missing are added.
    pub fn say(&mut self, path: &str, text: &str) {
        let (first, rest) = path.split_once('/').unwrap_or((path, ""));
        if self.child_mut(first).is_none() {
            self.push(Element { name: first.to_owned().into(), ..Element::default() });
        }
        match self.child_mut(first) {
            Some(child) if rest.is_empty() => child.children = vec![Child::Text(text.to_owned())],
            Some(child) => child.say(rest, text),
            None => {}
        }
    }

    /// Keeps the child elements for which `is_kept` returns true; it may change them.
    pub fn retain(&mut self, mut is_kept: impl FnMut(&mut Element) -> bool) {
        self.children.retain_mut(|child| match child {
            Child::Element(element) => is_kept(element),
            _ => true,
        });
    }

    /// Removes the child elements of a name; whether there were any.
    pub fn remove(&mut self, name: &str) -> bool {
        let before = self.children.len();
        self.children.retain(|child| !matches!(child, Child::Element(of) if of.name == name));
        self.children.len() < before
    }

    /// Sets an attribute, or removes it.
    pub fn set(&mut self, key: &str, value: Option<&str>) {
        self.attributes.retain(|(name, _)| name != key);
        self.attributes.extend(value.map(|value| (key.to_owned().into(), value.to_owned())));
    }

    /// Adds an attribute.
    pub fn with(mut self, key: &'static str, value: impl Into<String>) -> Self {
        self.attributes.push((key.into(), value.into()));
        self
    }

    /// Adds an attribute if there is a value.
    pub fn with_some(self, key: &'static str, value: Option<impl Into<String>>) -> Self {
        match value {
            Some(value) => self.with(key, value),
            None => self,
        }
    }

    /// Adds numbers as attributes, where there are any.
    pub fn with_numbers(
        self,
        values: impl IntoIterator<Item = (&'static str, Option<f64>)>,
    ) -> Self {
        let each = values.into_iter();
        each.fold(self, |element, (key, value)| element.with_some(key, value.map(number)))
    }

    /// Adds a child element.
    pub fn holding(mut self, child: Element) -> Self {
        self.push(child);
        self
    }

    /// Adds characters, as the only content.
    pub fn containing(mut self, text: &str) -> Self {
        self.children.push(Child::Text(text.to_owned()));
        self
    }

    /// Adds a child element.
    pub fn push(&mut self, child: Element) {
        self.children.push(Child::Element(child));
    }

    /// Adds raw XML, which must be a complete element.
    pub fn push_raw(&mut self, text: impl Into<String>) {
        self.children.push(Child::Raw(text.into()));
    }

    /// An element that contains characters alone.
    pub fn text(name: &'static str, text: &str) -> Self {
        Element { children: vec![Child::Text(text.to_owned())], ..Element::new(name) }
    }

    /// Adds child elements.
    pub fn extend(&mut self, children: impl IntoIterator<Item = Element>) {
        self.children.extend(children.into_iter().map(Child::Element));
    }

    /// Adds a child element, unless it contains nothing.
    pub fn push_filled(&mut self, child: Element) {
        if !child.children.is_empty() {
            self.push(child);
        }
    }

    /// Serializes the element alone.
    pub fn fragment(&self) -> String {
        let mut text = String::new();
        self.write(&mut text, 0, str::to_owned);
        text
    }

    /// Serializes a document with this root element, after the comments.
    pub fn document(&self, comments: &[String]) -> String {
        self.document_with(comments, str::to_owned)
    }

    /// As [`Element::document`]; `of` gives what is written for a text.
    pub fn document_with(&self, comments: &[String], of: fn(&str) -> String) -> String {
        let mut text = head(comments);
        self.write(&mut text, 0, of);
        text
    }

    fn write(&self, text: &mut String, depth: usize, of: fn(&str) -> String) {
        let margin = "  ".repeat(depth);
        *text += &format!("{margin}<{}", self.name);
        for (key, value) in &self.attributes {
            *text += &format!(" {key}=\"{}\"", escaped(&of(value)));
        }
        if self.children.is_empty() {
            *text += "/>\n";
            return;
        }
        if let [Child::Text(own)] = &self.children[..] {
            *text += &format!(">{}</{}>\n", escaped(&of(own)), self.name);
            return;
        }
        *text += ">\n";
        for child in &self.children {
            match child {
                Child::Element(element) => element.write(text, depth + 1, of),
                Child::Text(own) => *text += &format!("{margin}  {}\n", escaped(&of(own))),
                Child::Raw(raw) => *text += &format!("{margin}  {}\n", raw.trim()),
            }
        }
        *text += &format!("{margin}</{}>\n", self.name);
    }
}

/// The head of a document, with comments.
pub fn head(comments: &[String]) -> String {
    let comments = comments.iter().map(|text| comment(text));
    String::from("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n") + &comments.collect::<String>()
}

/// A comment on its own line, valid for any text: without `--` (XML 1.0, production 15), without a `-` at the end, and
/// without characters that XML excludes. These are escaped, as in `\u{2d}`.
pub fn comment(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in urdd_format::escape::line(&text.replace('{', "\\u{7b}")).chars() {
        match (c, safe.ends_with('-')) {
            ('-', true) => safe += "\\u{2d}",
            (c, _) => safe.push(c),
        }
    }
    // The space keeps a `-` away from the end.
    format!("<!-- {safe} -->\n")
}

/// Escapes characters, in content or as the value of an attribute. Tabs, line breaks and what a terminal would act upon
/// become character references, since XML readers replace the first two with spaces; braces too, since Jinja acts upon
/// them, by which `launch_param_builder` renders files for MoveIt.
pub fn escaped(value: &str) -> String {
    let mut text = String::with_capacity(value.len());
    for c in escape(value).chars() {
        match is_hidden(c) || c == '{' {
            true => text += &format!("&#{};", u32::from(c)),
            false => text.push(c),
        }
    }
    text
}
