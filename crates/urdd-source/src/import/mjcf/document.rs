//! An MJCF as one tree of elements: each `<include>` replaced by what is in its file.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use urdd_xml::{MAX_LEVELS, Mended, Node, parse_leniently};

use super::super::fault::ImportFault;
use super::super::place::{Place, TextFile, offset_of};
use super::super::unreachable::Unreachable;
use super::at::{Fallible, at};
use super::fault::MjcfFault;
use crate::gate::{Gate, unreachable};
use crate::resolve::FoundMesh;

/// An element.
#[derive(Debug)]
pub struct Element {
    pub tag: String,
    /// By name, in order.
    attributes: Vec<(String, String)>,
    pub children: Vec<Element>,
    pub place: Place,
}

impl Element {
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

    /// The children of a tag.
    pub fn all(&self, tag: &str) -> impl Iterator<Item = &Element> {
        self.children.iter().filter(move |child| child.tag == tag)
    }

    /// What the sections of a tag hold, in order.
    pub fn sections(&self, tag: &str) -> impl Iterator<Item = &Element> {
        self.all(tag).flat_map(|section| &section.children)
    }
}

/// Reads a description and what it includes: the files, the description first, and the outermost element.
pub fn read(file: TextFile, gate: &Gate) -> (Vec<TextFile>, Fallible<Element>) {
    let folder = file.path.parent().unwrap_or(Path::new("/")).to_owned();
    let name = file.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let text = file.text.clone();
    let mut expansion =
        Expansion { files: vec![file], folder, included: HashSet::from([name]), gate };
    let root = expansion.root(&text);
    (expansion.files, root)
}

struct Expansion<'r> {
    files: Vec<TextFile>,
    /// That of the description.
    folder: PathBuf,
    /// The names of files, as they are written.
    included: HashSet<String>,
    gate: &'r Gate,
}

impl Expansion<'_> {
    fn root(&mut self, text: &str) -> Fallible<Element> {
        let mended = Mended::default();
        let document = parse(text, 0, &mended)?;
        let node = document.root_element();
        let mut root = Element {
            tag: node.tag_name().name().to_owned(),
            attributes: attributes(node),
            children: Vec::new(),
            place: Place { file: 0, offset: mended.original(node.range().start) },
        };
        self.children(node, (0, &mended), 1, &mut root.children)?;
        Ok(root)
    }

    fn children(
        &mut self,
        parent: Node<'_, '_>,
        (file, mended): (usize, &Mended),
        depth: usize,
        into: &mut Vec<Element>,
    ) -> Fallible<()> {
        for node in parent.children().filter(Node::is_element) {
            let place = Place { file, offset: mended.original(node.range().start) };
            let tag = node.tag_name().name();
            if depth > MAX_LEVELS {
                return Err(at(place, MjcfFault::TooDeep(MAX_LEVELS)));
            }
            if tag.eq_ignore_ascii_case("include") {
                self.include(node, place, depth, into)?;
                continue;
            }
            let mut element = Element {
                tag: tag.to_owned(),
                attributes: attributes(node),
                children: Vec::new(),
                place,
            };
            self.children(node, (file, mended), depth + 1, &mut element.children)?;
            into.push(element);
        }
        Ok(())
    }

    fn include(
        &mut self,
        node: Node<'_, '_>,
        place: Place,
        depth: usize,
        into: &mut Vec<Element>,
    ) -> Fallible<()> {
        let name = node.attribute("file").filter(|_| !node.children().any(|of| of.is_element()));
        let name = name.ok_or_else(|| at(place, MjcfFault::Include))?;
        if !self.included.insert(name.to_owned()) {
            return Err(at(place, MjcfFault::IncludedTwice(name.to_owned())));
        }
        let beside = self.files[place.file].path.parent().map(|folder| folder.join(name));
        let places = [Some(self.folder.join(name)), beside];
        let unread = |fault| at(place, ImportFault::File(fault));
        let found = first(self.gate, places.into_iter().flatten(), name).map_err(unread)?;
        let read = TextFile::included(self.gate, &found).map_err(|fault| at(place, fault))?;
        let (file, text) = (self.files.len(), read.text.clone());
        self.files.push(read);
        let mended = Mended::default();
        let document = parse(&text, file, &mended)?;
        self.children(document.root_element(), (file, &mended), depth + 1, into)
    }
}

/// The first of some places that has a file which may be read. `name` is how the description names it.
pub fn first(
    gate: &Gate,
    places: impl IntoIterator<Item = PathBuf>,
    name: &str,
) -> Result<FoundMesh, Unreachable> {
    let mut fault = None;
    for place in places {
        match gate.at(&place) {
            Ok(found) => return Ok(found),
            Err(why) if why.outside.is_some() => {
                fault.get_or_insert(why);
            }
            Err(_) => {}
        }
    }
    Err(unreachable(name, fault.unwrap_or_default()))
}

fn attributes(node: Node<'_, '_>) -> Vec<(String, String)> {
    let each = node.attributes().map(|of| (of.name().to_owned(), of.value().to_owned()));
    let mut attributes: Vec<_> = each.collect();
    // Of names that differ in prefixes, the first counts: the order is kept.
    attributes.sort_by(|one, other| one.0.cmp(&other.0));
    attributes.dedup_by(|later, first| later.0 == first.0);
    attributes
}

fn parse<'t>(text: &'t str, file: usize, mended: &'t Mended) -> Fallible<urdd_xml::Document<'t>> {
    parse_leniently(text, "mujoco", mended).map_err(|error| {
        let place = Place { file, offset: offset_of(text, &error) };
        at(place, ImportFault::NotXml(error.words(text)))
    })
}
