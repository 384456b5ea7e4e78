//! What a program does because of something in a file.

pub use urdd_format::report::Deed;
use urdd_format::short;

use crate::fault::{Fault, NO_SHAPE};
use crate::part::Part;
use crate::tree::{Attribute, Node, Parsed, Tree};

/// What a program does, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Effect {
    /// What it does.
    pub deed: Deed,
    /// The element or attribute that is the reason: its first byte in the file.
    pub at: usize,
    /// The part that is lost or read otherwise, such as `joint/elbow/limit`; empty for the whole file.
    pub part: Part,
    /// What is wrong there, or what the program does not know.
    pub fault: Fault,
    /// What it makes of the part, if it reads it otherwise: `1`, `fixed`.
    pub makes: Option<String>,
}

/// What a program does with a file, as its reader finds it out.
#[derive(Debug, Clone, Default)]
pub struct Effects(pub Vec<Effect>);

/// The file is refused: reading ends.
pub(crate) struct Refused;

/// What a reader's functions give: nothing more where the program stops.
pub(crate) type Reading<T> = Result<T, Refused>;

impl Effects {
    /// The worst that happens; none if all is read as it is written.
    pub fn worst(&self) -> Option<Deed> {
        self.0.iter().map(|effect| effect.deed).max()
    }

    /// Whether the program has a robot in the end.
    pub fn loads(&self) -> bool {
        self.worst().is_none_or(|worst| worst < Deed::Refuses)
    }

    fn add(&mut self, deed: Deed, at: usize, part: Part, fault: Fault, makes: Option<&str>) {
        let makes = makes.map(|makes| short::name(makes).into_owned());
        self.0.push(Effect { deed, at, part, fault, makes });
    }

    pub(crate) fn refuse<T>(&mut self, at: impl At, fault: Fault) -> Reading<T> {
        self.add(Deed::Refuses, at.at(), Part::default(), fault, None);
        Err(Refused)
    }

    pub(crate) fn crash<T>(&mut self, at: impl At, fault: Fault) -> Reading<T> {
        self.add(Deed::Crashes, at.at(), Part::default(), fault, None);
        Err(Refused)
    }

    pub(crate) fn drop(&mut self, at: impl At, part: impl Into<Part>, fault: Fault) {
        self.add(Deed::Drops, at.at(), part.into(), fault, None);
    }

    pub(crate) fn read_as(
        &mut self,
        at: impl At,
        part: impl Into<Part>,
        fault: Fault,
        makes: impl AsRef<str>,
    ) {
        self.add(Deed::Reads, at.at(), part.into(), fault, Some(makes.as_ref()));
    }

    /// Something that the program never reads.
    pub(crate) fn unread(&mut self, at: impl At, part: impl Into<Part>, name: &str) {
        self.drop(at, part, Fault::NeverRead(name.into()));
    }

    /// Elements that the program never reads, where they are there. `names` has spaces between them.
    pub(crate) fn unread_elements(&mut self, node: Node<'_>, names: &str, part: &Part) {
        for name in names.split(' ') {
            if let Some(found) = node.child(name) {
                self.unread(found, part.inside(name), name);
            }
        }
    }

    /// Attributes that the program never reads, where they are there. `names` has spaces between them.
    pub(crate) fn unread_attributes(&mut self, node: Node<'_>, names: &str, part: &Part) {
        for name in names.split(' ') {
            if let Some(found) = node.attribute(name) {
                self.unread(found, part.inside(name), name);
            }
        }
    }

    /// A `<geometry>` in which the program finds no shape.
    pub(crate) fn shapeless<T>(&mut self, geometry: Node<'_>) -> Reading<T> {
        match geometry.children().next() {
            Some(other) => self.refuse(other, Fault::Shape(other.name().into())),
            None => self.refuse(geometry, NO_SHAPE),
        }
    }

    /// What a parser made of the file.
    pub(crate) fn parsed<T>(&mut self, parsed: Parsed<T>) -> Reading<T> {
        parsed.or_else(|bad| self.refuse(bad.at, Fault::Xml(bad.why)))
    }

    /// The first `<robot>` that is in no other element.
    pub(crate) fn robot<'t>(&mut self, tree: &'t Tree<'t>) -> Reading<Node<'t>> {
        match tree.tops().find(|top| top.name() == "robot") {
            Some(robot) => Ok(robot),
            None => self.refuse(0, Fault::NotRobot),
        }
    }

    pub(crate) fn needed<'t>(
        &mut self,
        node: Node<'t>,
        name: &'static str,
    ) -> Reading<&'t Attribute<'t>> {
        match node.attribute(name) {
            Some(value) => Ok(value),
            None => self.refuse(node, Fault::Missing(name)),
        }
    }

    pub(crate) fn needed_element<'t>(
        &mut self,
        node: Node<'t>,
        name: &'static str,
    ) -> Reading<Node<'t>> {
        match node.child(name) {
            Some(child) => Ok(child),
            None => self.refuse(node, Fault::MissingElement(name)),
        }
    }
}

/// Something with a place in the file.
pub(crate) trait At {
    /// Its first byte.
    fn at(self) -> usize;
}

impl At for usize {
    fn at(self) -> usize {
        self
    }
}

impl At for Node<'_> {
    fn at(self) -> usize {
        self.start()
    }
}

impl At for &Attribute<'_> {
    fn at(self) -> usize {
        self.range.start
    }
}
