//! An XML document as a program's own parser made it, with places in the text.

use std::borrow::Cow;
use std::ops::Range;

pub use urdd_xml::tinyxml2::{Attribute, Malformed, repeated};

pub type Parsed<T> = Result<T, Malformed>;

/// Why a text is refused that a program makes of a file within the limits, if it is beyond them.
pub const BEYOND: &str = "the program's own form of the file is beyond the limits of XML";

#[derive(Default)]
pub struct Tree<'a> {
    pub elements: Vec<Element<'a>>,
    /// The elements that are in no other; one in a document that is well-formed.
    pub tops: Vec<usize>,
    /// Where text begins that is in no element, if the parser lets it pass.
    pub stray: Option<usize>,
}

pub struct Element<'a> {
    /// With its prefix, if the parser knows no namespaces.
    pub name: Cow<'a, str>,
    pub attributes: Vec<Attribute<'a>>,
    /// Indices of the elements inside, in order.
    pub children: Vec<usize>,
    /// The text before the first child of another kind; none if there is an element first.
    pub text: Option<Cow<'a, str>>,
    /// From `<` to the end of the start tag, bytes of the file.
    pub tag: Range<usize>,
}

impl<'a> Element<'a> {
    pub fn new(name: Cow<'a, str>, attributes: Vec<Attribute<'a>>, tag: Range<usize>) -> Self {
        Element { name, attributes, children: Vec::new(), text: None, tag }
    }
}

#[derive(Clone, Copy)]
pub struct Node<'t> {
    tree: &'t Tree<'t>,
    pub index: usize,
}

impl<'t> Tree<'t> {
    /// Adds an element in another one, or in none. Returns its index.
    pub fn push(&mut self, element: Element<'t>, above: Option<usize>) -> usize {
        let index = self.elements.len();
        match above.and_then(|above| self.elements.get_mut(above)) {
            Some(above) => above.children.push(index),
            None => self.tops.push(index),
        }
        self.elements.push(element);
        index
    }

    pub fn tops(&'t self) -> impl Iterator<Item = Node<'t>> {
        self.tops.iter().map(move |&index| Node { tree: self, index })
    }

    /// All elements of a name, wherever they are, in order.
    pub fn named(&'t self, name: &str) -> impl Iterator<Item = Node<'t>> {
        let named = self.elements.iter().enumerate().filter(move |(_, one)| one.name == name);
        named.map(|(index, _)| Node { tree: self, index })
    }
}

impl<'t> Node<'t> {
    fn element(self) -> &'t Element<'t> {
        &self.tree.elements[self.index]
    }

    pub fn name(self) -> &'t str {
        &self.element().name
    }

    pub fn text(self) -> Option<&'t str> {
        self.element().text.as_deref()
    }

    pub fn start(self) -> usize {
        self.element().tag.start
    }

    pub fn attributes(self) -> &'t [Attribute<'t>] {
        &self.element().attributes
    }

    pub fn attribute(self, name: &str) -> Option<&'t Attribute<'t>> {
        self.element().attributes.iter().find(|one| one.name == name)
    }

    pub fn value(self, name: &str) -> Option<&'t str> {
        self.attribute(name).map(|one| &*one.value)
    }

    /// Whether it has neither attributes nor elements.
    pub fn is_empty(self) -> bool {
        self.attributes().is_empty() && self.child_count() == 0
    }

    pub fn children(self) -> impl Iterator<Item = Node<'t>> + Clone {
        let tree = self.tree;
        self.element().children.iter().map(move |&index| Node { tree, index })
    }

    pub fn named(self, name: &str) -> impl Iterator<Item = Node<'t>> + Clone {
        self.children().filter(move |child| child.name() == name)
    }

    /// Whether another element has the same attributes and elements in it.
    pub fn is_like(self, other: Node<'_>) -> bool {
        let mut open = vec![(self, other)];
        while let Some((one, other)) = open.pop() {
            let (first, second) = (one.attributes().iter(), other.attributes().iter());
            let (inside, beside) = (one.children(), other.children());
            let is_same = one.name() == other.name()
                && first.len() == second.len()
                && first.zip(second).all(|(a, b)| a.name == b.name && a.value == b.value)
                && one.child_count() == other.child_count();
            if !is_same {
                return false;
            }
            open.extend(inside.zip(beside));
        }
        true
    }

    /// Another element beside the first of a name that says something else than it does.
    pub fn repeated(self, name: &str) -> Option<Node<'t>> {
        let mut all = self.named(name).filter(|node| !node.is_empty());
        let first = all.next()?;
        all.find(|other| !other.is_like(first))
    }

    fn child_count(self) -> usize {
        self.element().children.len()
    }

    pub fn child(self, name: &str) -> Option<Node<'t>> {
        self.named(name).next()
    }
}
