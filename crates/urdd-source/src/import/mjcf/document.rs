//! An MJCF as one tree of elements: each `<include>` replaced by what is in its file.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use urdd_xml::Node;
use urdd_xml::{Kind, MAX_LEVELS, MAX_ROBOT_ELEMENTS};

use super::super::fault::ImportFault;
use super::super::place::{Place, TextFile, offset_of};
use super::super::reach::Reach;
use super::super::unreachable::Unreachable;
use super::at::{Fallible, at};
use super::fault::MjcfFault;
use crate::files::MAX_SOURCE_BYTES;

/// An element.
#[derive(Debug)]
pub struct Element {
    pub tag: String,
    pub attributes: Vec<(String, String)>,
    pub children: Vec<Element>,
    pub place: Place,
}

impl Element {
    /// The text of an attribute.
    pub fn get(&self, name: &str) -> Option<&str> {
        let mut attributes = self.attributes.iter();
        attributes.find(|(key, _)| key == name).map(|(_, value)| value.as_str())
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
pub fn read(file: TextFile, reach: &Reach) -> (Vec<TextFile>, Fallible<Element>) {
    let folder = file.path.parent().unwrap_or(Path::new("/")).to_owned();
    let name = file.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let text = file.text.clone();
    let mut expansion = Expansion {
        files: vec![file],
        folder,
        included: HashSet::from([name]),
        reach,
        elements: 0,
    };
    let root = expansion.root(&text);
    (expansion.files, root)
}

struct Expansion<'r> {
    files: Vec<TextFile>,
    /// That of the description.
    folder: PathBuf,
    /// The names of files, as they are written.
    included: HashSet<String>,
    reach: &'r Reach,
    elements: usize,
}

impl Expansion<'_> {
    fn root(&mut self, text: &str) -> Fallible<Element> {
        let document = parse(text, 0)?;
        let node = document.root_element();
        let mut root = Element {
            tag: node.tag_name().name().to_owned(),
            attributes: attributes(node),
            children: Vec::new(),
            place: Place { file: 0, offset: node.range().start },
        };
        self.children(node, 0, 1, &mut root.children)?;
        Ok(root)
    }

    fn children(
        &mut self,
        parent: Node<'_, '_>,
        file: usize,
        depth: usize,
        into: &mut Vec<Element>,
    ) -> Fallible<()> {
        for node in parent.children().filter(Node::is_element) {
            let place = Place { file, offset: node.range().start };
            let tag = node.tag_name().name();
            self.elements += 1;
            if self.elements > MAX_ROBOT_ELEMENTS {
                return Err(at(place, ImportFault::TooMany(MAX_ROBOT_ELEMENTS)));
            }
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
            self.children(node, file, depth + 1, &mut element.children)?;
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
        let (path, bytes) = first(self.reach, &places.map(Option::unwrap_or_default), name)
            .map_err(|fault| at(place, ImportFault::File(fault)))?;
        let read = TextFile::included(path, bytes);
        let read = read.map_err(|fault| at(place, ImportFault::File(fault)))?;
        let (file, text) = (self.files.len(), read.text.clone());
        self.files.push(read);
        self.children(parse(&text, file)?.root_element(), file, depth, into)
    }
}

/// The first of some places that has a file. `name` is how the description names it.
pub fn first(
    reach: &Reach,
    places: &[PathBuf],
    name: &str,
) -> Result<(PathBuf, Vec<u8>), Unreachable> {
    let mut fault = None;
    for place in places {
        match reach.read(place, MAX_SOURCE_BYTES) {
            Ok(found) => return Ok(found),
            Err(Unreachable::Missing(_)) => {}
            Err(other) => {
                fault.get_or_insert(other);
            }
        }
    }
    Err(fault.unwrap_or_else(|| Unreachable::Missing(name.to_owned())))
}

fn attributes(node: Node<'_, '_>) -> Vec<(String, String)> {
    node.attributes().map(|of| (of.name().to_owned(), of.value().to_owned())).collect()
}

fn parse(text: &str, file: usize) -> Fallible<urdd_xml::Document<'_>> {
    urdd_xml::parse(text, Kind::Other).map_err(|error| {
        let place = Place { file, offset: offset_of(text, &error) };
        at(place, ImportFault::NotXml(error.words(text)))
    })
}
