//! Elements of an MJCF.

use super::super::place::Place;

/// An element.
#[derive(Debug, Clone)]
pub struct Element {
    pub tag: String,
    /// By name, in order.
    attributes: Vec<(String, String)>,
    pub children: Vec<Element>,
    pub place: Place,
}

impl Element {
    /// An element without children. Of attributes of one name, the first counts.
    pub fn new(tag: String, mut attributes: Vec<(String, String)>, place: Place) -> Self {
        attributes.sort_by(|one, other| one.0.cmp(&other.0));
        attributes.dedup_by(|later, first| later.0 == first.0);
        Element { tag, attributes, children: Vec::new(), place }
    }

    /// Sets an attribute.
    pub fn set(&mut self, name: &str, value: String) {
        match self.attributes.binary_search_by(|(key, _)| key.as_str().cmp(name)) {
            Ok(at) => self.attributes[at].1 = value,
            Err(at) => self.attributes.insert(at, (name.to_owned(), value)),
        }
    }

    /// The text of an attribute.
    pub fn get(&self, name: &str) -> Option<&str> {
        let found = self.attributes.binary_search_by(|(key, _)| key.as_str().cmp(name));
        found.ok().map(|at| self.attributes[at].1.as_str())
    }

    /// The bytes of its attributes.
    pub fn length(&self) -> usize {
        self.attributes.iter().map(|(name, value)| name.len() + value.len()).sum()
    }

    /// The names of its attributes, in order.
    pub fn attribute_names(&self) -> impl Iterator<Item = &str> {
        self.attributes.iter().map(|(name, _)| name.as_str())
    }

    /// The text of an attribute, unless it is empty.
    pub fn text(&self, name: &str) -> Option<&str> {
        self.get(name).filter(|text| !text.is_empty())
    }

    /// The name of its file, without folders and ending: what an asset is called that has no name.
    pub fn stem(&self) -> Option<&str> {
        let file = self.text("file")?;
        let base = file.rsplit(['/', '\\']).next().unwrap_or(file);
        Some(base.rsplit_once('.').map_or(base, |(stem, _)| stem))
    }

    /// The children of a tag.
    pub fn all(&self, tag: &str) -> impl Iterator<Item = &Element> {
        self.children.iter().filter(move |child| child.tag == tag)
    }

    /// What the sections of a tag hold, in order.
    pub fn sections(&self, tag: &str) -> impl Iterator<Item = &Element> {
        self.all(tag).flat_map(|section| &section.children)
    }
}
