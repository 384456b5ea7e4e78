//! The elements of a text.

use std::borrow::Cow;

use super::scan::{Attribute, Element, scan};

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
