//! A URDF as tinyxml2 makes a tree of it.

use std::borrow::Cow;

use urdd_xml::Counted;
use urdd_xml::tinyxml2::{Event, Parser};

use crate::tree::{Element, Malformed, Parsed, Tree};

/// Elements that are open at once, from which tinyxml2 refuses, and from which its releases up to 9 do.
pub(crate) const MAX_DEPTH: usize = 499;
pub(crate) const OLD_MAX_DEPTH: usize = 99;

/// More elements in each other than URDF ever has.
pub(crate) const MOST_DEPTH: usize = 1000;

/// A file, parsed once for releases that allow other depths.
pub(crate) struct Document<'a> {
    tree: Parsed<Tree<'a>>,
    /// The first element that is open at each depth, bytes of the file.
    depths: Vec<usize>,
}

impl<'a> Document<'a> {
    pub fn of(file: Counted<'a>) -> Self {
        let mut making = Making::default();
        let parsed = making.file(file.bytes());
        Document { tree: parsed.map(|()| making.tree), depths: making.depths }
    }

    /// What a release makes of it that refuses an element which is open and `max_depth` elements deep.
    pub fn within(&self, max_depth: usize) -> Parsed<&Tree<'a>> {
        match (self.depths.get(max_depth - 1), &self.tree) {
            (Some(&at), _) => Err(Malformed { at, why: TOO_DEEP }),
            (None, Ok(tree)) => Ok(tree),
            (None, Err(bad)) => Err(*bad),
        }
    }
}

const TOO_DEEP: &str = "elements are nested too deep";

/// A tree that is being made.
#[derive(Default)]
struct Making<'a> {
    tree: Tree<'a>,
    /// The elements that are not closed yet: index, and whether anything is inside.
    open: Vec<(usize, bool)>,
    depths: Vec<usize>,
}

impl<'a> Making<'a> {
    fn file(&mut self, bytes: &'a [u8]) -> Parsed<()> {
        let mut parser = Parser::new(bytes)?;
        while let Some(event) = parser.event()? {
            match event {
                Event::Unknown => self.inside(None),
                Event::Text(text, at) => {
                    if self.open.is_empty() {
                        self.tree.stray.get_or_insert(at);
                    }
                    self.inside(Some(text));
                }
                Event::Data(text) => self.inside(Some(text)),
                Event::End => drop(self.open.pop()),
                Event::Start { name, attributes, tag, is_empty } => {
                    let start = tag.start;
                    self.inside(None);
                    let above = self.open.last().map(|(open, _)| *open);
                    let index = self.tree.push(Element::new(name, attributes, tag), above);
                    if !is_empty {
                        self.open.push((index, false));
                        if self.open.len() > self.depths.len() {
                            self.depths.push(start);
                        }
                        if self.depths.len() == MOST_DEPTH {
                            return Err(Malformed { at: start, why: TOO_DEEP });
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// Notes a node in the element that is open.
    fn inside(&mut self, text: Option<Cow<'a, str>>) {
        if let Some((open, is_filled)) = self.open.last_mut() {
            if !*is_filled {
                self.tree.elements[*open].text = text;
            }
            *is_filled = true;
        }
    }
}
