//! What a program does because of something in a file, the part of the robot that it does it to, and what materials look like.

use std::collections::HashSet;
use std::fmt::Display;
use std::ops::Deref;
use std::sync::Arc;

pub use urdd_format::report::Deed;
use urdd_format::short;

use crate::fault::{Fault, NO_SHAPE};
use crate::number::{pieces, strtod, whole};
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
    /// Whether the program does so only once what it refuses before is mended: its reader goes on as if it were.
    pub is_supposed: bool,
}

/// Maximum number of effects that are kept of a program; the rest are counted. As many places are kept of a finding.
pub const KEPT: usize = 10_000;

/// What a program does with a file, as its reader finds it out. What the program refuses first is always among what is kept.
///
/// A reader goes on behind a refusal as if it were mended, as far as what comes then does not depend on how it is mended.
/// `refuse_mendable` is for a value that nothing else needs. After `refuse` the rest of the part is
/// not read: whoever reads a robot's parts one by one goes on with the next, and asks `are_read` before what
/// needs all of them.
#[derive(Debug, Clone, Default)]
pub struct Effects {
    kept: Vec<Effect>,
    /// What the program does that refuses the file, or crashes: the first such effect.
    end: Option<Deed>,
    /// The number of parts that were not read to their end.
    unread_parts: usize,
    /// Where something is refused, once a place, and names that nothing has, once a name.
    refused: HashSet<usize>,
    unknown: HashSet<Fault>,
    /// Number of the others.
    cut: usize,
    /// The worst of the others, and of those of them that are not usual.
    worst_cut: [Option<Deed>; 2],
}

/// How much was known of a file.
#[derive(Clone, Copy)]
pub(crate) struct Mark(usize, usize);

/// A part of the file, or all of it, is refused, and not read further.
pub struct Refused;

/// What a reader's functions give: nothing where a part is not read to its end.
pub type Reading<T> = Result<T, Refused>;

impl Effects {
    /// The worst that happens; none if all is read as it is written.
    pub fn worst(&self) -> Option<Deed> {
        self.end.or_else(|| self.kept.iter().map(|effect| effect.deed).max().max(self.worst_cut[0]))
    }

    /// The worst that is not what the program does with every such part. A refusal is never usual.
    pub fn worst_unusual(&self) -> Option<Deed> {
        let unusual = self.kept.iter().filter(|effect| !effect.fault.is_usual());
        let worst = || unusual.map(|effect| effect.deed).max().max(self.worst_cut[1]);
        self.end.or_else(worst)
    }

    /// What is kept.
    pub fn kept(&self) -> &[Effect] {
        &self.kept
    }

    /// As [`Effects::kept`], to change it.
    pub fn kept_mut(&mut self) -> &mut [Effect] {
        &mut self.kept
    }

    /// What is kept, taken.
    pub fn into_kept(self) -> Vec<Effect> {
        self.kept
    }

    /// The number of effects that are not kept.
    pub fn cut(&self) -> usize {
        self.cut
    }

    pub(crate) fn mark(&self) -> Mark {
        Mark(self.kept.len(), self.cut)
    }

    /// Forgets what came after a mark.
    pub(crate) fn forget(&mut self, Mark(kept, cut): Mark) {
        self.kept.truncate(kept);
        self.cut = cut;
    }

    /// Counts effects that nobody kept.
    pub(crate) fn count(&mut self, count: usize, deed: Deed) {
        self.cut += count;
        let worst = Some(deed).filter(|_| count > 0);
        self.worst_cut = self.worst_cut.map(|known| known.max(worst));
    }

    /// Whether the program has a robot in the end.
    pub fn loads(&self) -> bool {
        self.end.is_none()
    }

    /// Whether what the program refuses is that files are not there, or not for it, and nothing else.
    pub(crate) fn lacks_files_alone(&self) -> bool {
        let is_of_files = |fault: &Fault| {
            matches!(fault, Fault::NotFound(_) | Fault::Mesh(_) | Fault::ForOthers(_))
        };
        self.kept.iter().all(|effect| effect.deed < Deed::Refuses || is_of_files(&effect.fault))
    }

    /// How many parts were not read to their end up to here.
    pub(crate) fn unread_parts(&self) -> usize {
        self.unread_parts
    }

    /// Whether all parts are read that came after so many were not; `Refused` if not: what needs them is not known.
    pub(crate) fn are_read(&self, since: usize) -> Reading<()> {
        if self.unread_parts > since { Err(Refused) } else { Ok(()) }
    }

    fn add(&mut self, deed: Deed, at: usize, part: Part, fault: Fault, makes: Option<&str>) {
        let is_supposed = self.end.is_some();
        if deed >= Deed::Refuses {
            self.end.get_or_insert(deed);
            let is_unknown = matches!(fault, Fault::Unknown { .. });
            if !self.refused.insert(at) || is_unknown && !self.unknown.insert(fault.clone()) {
                return;
            }
        }
        if self.kept.len() >= KEPT && (deed < Deed::Refuses || is_supposed) {
            self.cut += 1;
            let unusual = Some(deed).filter(|_| !fault.is_usual());
            self.worst_cut = [self.worst_cut[0].max(Some(deed)), self.worst_cut[1].max(unusual)];
            return;
        }
        let makes = makes.map(|makes| short::name(makes).into_owned());
        self.kept.push(Effect { deed, at, part, fault, makes, is_supposed });
    }

    /// The file is refused, and the part not read further.
    pub(crate) fn refuse<T>(&mut self, at: impl At, fault: Fault) -> Reading<T> {
        self.refuse_mendable(at, fault);
        self.unread_parts += 1;
        Err(Refused)
    }

    /// The file is refused for something that nothing else needs: reading goes on as if it were mended.
    pub(crate) fn refuse_mendable(&mut self, at: impl At, fault: Fault) {
        self.add(Deed::Refuses, at.at(), Part::default(), fault, None);
    }

    /// As [`Effects::refuse`], of a program that crashes.
    pub(crate) fn crash<T>(&mut self, at: impl At, fault: Fault) -> Reading<T> {
        self.crash_mendable(at, fault);
        self.unread_parts += 1;
        Err(Refused)
    }

    /// As [`Effects::refuse_mendable`], of a program that crashes.
    pub(crate) fn crash_mendable(&mut self, at: impl At, fault: Fault) {
        self.add(Deed::Crashes, at.at(), Part::default(), fault, None);
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
pub trait At {
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

/// A part of a robot, such as `joint/elbow/limit`; empty for the whole file. It is made of names, and a long name is
/// shortened where it enters: a part is short, however many effects have it.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
pub struct Part(Arc<str>);

impl Part {
    /// The part of a kind and name.
    pub(crate) fn of(kind: &str, name: &str) -> Self {
        Part(format!("{kind}/{}", short::name(name)).into())
    }

    pub(crate) fn inside(&self, what: impl Display) -> Self {
        Part(format!("{}/{what}", self.0).into())
    }

    /// The visuals or collisions of a link whose part it is, and the part of each.
    pub(crate) fn shapes<'t>(
        &self,
        link: Node<'t>,
        kind: &'static str,
    ) -> impl Iterator<Item = (Node<'t>, Part)> {
        let part = move |(index, shape)| (shape, self.inside(format_args!("{kind}/{index}")));
        link.named(kind).enumerate().map(part)
    }
}

impl From<&'static str> for Part {
    fn from(part: &'static str) -> Self {
        Part(part.into())
    }
}

impl From<&Part> for Part {
    fn from(part: &Part) -> Self {
        part.clone()
    }
}

impl Deref for Part {
    type Target = str;
    fn deref(&self) -> &str {
        &self.0
    }
}

/// A colour as it is written, read once, however many others are compared with it.
#[derive(Clone)]
pub struct Color {
    pub text: String,
    numbers: Option<Vec<f64>>,
}

impl Color {
    pub fn of(rgba: &str) -> Self {
        let numbers = pieces(rgba).map(|piece| whole(strtod(piece))).collect();
        Color { text: rgba.to_owned(), numbers }
    }

    /// Whether nobody sees a difference: of half a step of 8 bits, as texts are rounded.
    pub fn is_same(&self, other: &Color) -> bool {
        const LEAST: f64 = 0.5 / 255.0;
        match (&self.numbers, &other.numbers) {
            (Some(one), Some(other)) => {
                let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= LEAST;
                one.len() == other.len() && one.iter().zip(other).all(is_near)
            }
            _ => self.text == other.text,
        }
    }
}

/// What a material has itself.
pub struct Look {
    color: Color,
    texture: String,
}

impl Look {
    /// None where it has nothing: a visual's material is then the name of another.
    pub fn of(material: Node<'_>) -> Option<Look> {
        let of = |element: &str, name: &str| material.child(element)?.value(name);
        let (rgba, texture) = (of("color", "rgba"), of("texture", "filename"));
        rgba.or(texture)?;
        let color = Color::of(rgba.unwrap_or_default());
        Some(Look { color, texture: texture.unwrap_or_default().to_owned() })
    }

    /// Says that a material is read as another one of its name, if that looks otherwise.
    pub fn compare(read: Option<&Look>, material: Node<'_>, part: &Part, effects: &mut Effects) {
        let (Some(read), Some(own)) = (read, Look::of(material)) else { return };
        if read.texture != own.texture || !read.color.is_same(&own.color) {
            let name = material.value("name").unwrap_or_default();
            let rgba = &read.color.text;
            let words = if rgba.is_empty() { &read.texture } else { rgba };
            effects.read_as(material, part, Fault::not_unique("material", name), &**words);
        }
    }
}
