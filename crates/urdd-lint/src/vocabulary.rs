//! Elements, attributes and names of a URDF: how they are read, what is near to them, and which ones URDF does not define.

use std::collections::{HashMap, HashSet};
use std::sync::atomic::{AtomicUsize, Ordering};

use urdd_format::nearest::closeness;
use urdd_format::short;
use urdd_xml::Node;
use urdd_xml::element::children;
pub use urdd_xml::element::{CLOSED, KNOWN, Known, of};

/// The joint types that have an axis.
pub const WITH_AXIS: [&str; 4] = ["revolute", "continuous", "prismatic", "planar"];
/// The joint types of one degree of freedom.
pub const ONE_DOF: [&str; 3] = ["revolute", "continuous", "prismatic"];

/// The child elements of a name.
pub fn named<'a>(node: Node<'a, 'a>, wanted: &str) -> impl Iterator<Item = Node<'a, 'a>> {
    children(node).filter(move |(name, _)| *name == wanted).map(|(_, child)| child)
}

/// The first child element of a name.
pub fn child<'a>(node: Node<'a, 'a>, wanted: &str) -> Option<Node<'a, 'a>> {
    named(node, wanted).next()
}

/// Finite numbers in an attribute, separated by white space; `None` if they are not `N` numbers (URD011 says so).
pub fn numbers<const N: usize>(node: Node, name: &str) -> Option<[f64; N]> {
    let words = node.attribute(name)?.split_ascii_whitespace();
    let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
    let numbers = <[f64; N]>::try_from(numbers?).ok()?;
    numbers.iter().all(|number| number.is_finite()).then_some(numbers)
}

/// A finite number in an attribute.
pub fn number(node: Node, name: &str) -> Option<f64> {
    numbers::<1>(node, name).map(|[number]| number)
}

/// The path of an element, without its place among those of the same name: findings at the same kind of element are one.
pub fn kind(node: Node) -> String {
    /// URDF is less deep.
    const LEVELS: usize = 8;
    let inside = node.ancestors().take_while(|node| node.parent_element().is_some());
    let names = inside.take(LEVELS).map(|one| short::name(one.tag_name().name()));
    let mut parts: Vec<_> = names.map(|name| format!("/{name}/*")).collect();
    parts.reverse();
    parts.concat()
}

/// The name that another one is a misspelling of: the nearest, one edit away, or two where both have six letters, in any
/// case; or the only one that it is the beginning of.
pub fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    near(name, known).map(|(best, _)| best)
}

/// The names that something may have.
pub struct Names<'a> {
    all: Vec<&'a str>,
    set: HashSet<&'a str>,
    left: AtomicUsize,
}

/// Maximum number of steps of comparisons with all names: beyond, names that are not there have no hint.
const MAX_STEPS: usize = 4_000_000;

impl<'a> Names<'a> {
    /// All of these, of which some may be the same.
    pub fn new(names: impl Iterator<Item = &'a str>) -> Self {
        let all: Vec<&str> = names.collect();
        Names { set: all.iter().copied().collect(), all, left: MAX_STEPS.into() }
    }

    /// Whether a name is one of them.
    pub fn has(&self, name: &str) -> bool {
        self.set.contains(name)
    }

    /// What a message says of the name that is meant, if any: nothing where numbers or sides differ, as in `arm_1` and `arm_2`.
    pub fn hint(&self, name: &str) -> String {
        let steps = self.all.len() * (1 + name.len().min(LONG).pow(2) / 8);
        let left = self.left.load(Ordering::Relaxed).checked_sub(steps);
        let Some(left) = left.filter(|_| name.len() <= LONG) else { return String::new() };
        self.left.store(left, Ordering::Relaxed);
        match nearest(name, &self.all).filter(|near| !closeness(near, name).is_of_another_part) {
            Some(near) => format!(", but there is `{near}`"),
            None => String::new(),
        }
    }
}

/// Whether a value is one that an attribute of URDF can have: as many numbers as it needs, or a word.
pub fn fits(attribute: &str, value: &str) -> bool {
    let wanted = match attribute {
        "name" | "type" | "version" | "filename" | "link" | "joint" => return !value.is_empty(),
        "xyz" | "rpy" | "size" | "scale" => 3,
        "rgba" | "quat_xyzw" => 4,
        _ => 1,
    };
    let mut numbers = value.split_ascii_whitespace().map(str::parse);
    let is_finite = |number: Result<f64, _>| number.is_ok_and(f64::is_finite);
    numbers.clone().count() == wanted && numbers.all(is_finite)
}

/// Longer names are not compared, bytes.
const LONG: usize = 100;
/// Names that are two edits apart differ by fewer bytes.
const MOST_BYTES: usize = 9;

/// As [`nearest`], and whether no other name is as near.
pub fn near<'a>(name: &str, known: &[&'a str]) -> Option<(&'a str, bool)> {
    if name.len() > LONG {
        return None;
    }
    let lower = name.to_lowercase();
    let longer: Vec<_> = known.iter().filter(|known| known.starts_with(&lower)).collect();
    if let ([one], true) = (&longer[..], lower.chars().count() >= 5) {
        return Some((one, true));
    }
    let is_near = |known: &&&str| known.len().abs_diff(lower.len()) < MOST_BYTES;
    let found = known.iter().filter(is_near).map(|known| (closeness(known, name), *known));
    let found: Vec<_> = found.collect();
    let &(least, best) = found.iter().min()?;
    let letters = lower.chars().count().min(best.chars().count());
    let allowed = match letters {
        0..3 => 0,
        3..6 => 1,
        _ => 2,
    };
    let is_only = found.iter().filter(|(one, _)| one.edits == least.edits).count() == 1;
    (least.edits <= allowed).then_some((best, is_only))
}

/// Something that URDF does not define.
#[derive(Debug, Clone)]
pub struct Unknown<'a> {
    /// The element, or that of the attribute.
    pub node: Node<'a, 'a>,
    /// Which of them it is.
    pub what: What<'a>,
    /// What it is a misspelling of.
    pub meant: Option<&'static str>,
    /// Whether no other name is as near.
    pub is_only: bool,
    /// The elements that something of this name belongs to.
    pub belongs: Vec<&'static str>,
}

/// An element or an attribute.
#[derive(Debug, Clone, Copy)]
pub enum What<'a> {
    /// The element itself.
    Element,
    /// Its attribute of this name.
    Attribute(&'a str),
}

impl<'a> Unknown<'a> {
    /// `near` is the name that is meant, and whether no other is as near; `has` finds the elements that it belongs to.
    fn new(
        node: Node<'a, 'a>,
        what: What<'a>,
        near: Option<(&'static str, bool)>,
        has: impl Fn(&&Known) -> bool,
    ) -> Self {
        let (meant, is_only) = near.unzip();
        let belongs = KNOWN.iter().filter(has).map(|known| known.name).collect();
        Unknown { node, what, meant, is_only: is_only == Some(true), belongs }
    }
}

/// Attributes that many elements have: one in a wrong place says nothing.
const EVERYWHERE: [&str; 5] = ["name", "type", "value", "link", "joint"];

/// All that is unknown in a robot.
pub fn unknown<'a>(root: Node<'a, 'a>) -> Vec<Unknown<'a>> {
    let mut found = Vec::new();
    // A file may have one misspelling very often.
    let mut near_children: HashMap<(&str, &str), Option<(&'static str, bool)>> = HashMap::new();
    let mut left: Vec<(Node<'a, 'a>, &'static Known)> =
        of("robot").map(|known| (root, known)).into_iter().collect();
    while let Some((node, known)) = left.pop() {
        let attributes = node.attributes().filter(|attribute| attribute.namespace().is_none());
        for attribute in attributes {
            let name = attribute.name();
            if !known.attributes.contains(&name) && !known.other_attributes.contains(&name) {
                let has = |known: &&Known| {
                    known.attributes.contains(&name) && !EVERYWHERE.contains(&name)
                };
                let near = near_attribute(node, name, known.attributes);
                found.push(Unknown::new(node, What::Attribute(name), near, has));
            }
        }
        for (name, child) in children(node).filter(|(name, _)| !name.contains(':')) {
            if known.children.contains(&name) {
                let inside = of(name).filter(|_| !CLOSED.contains(&name));
                left.extend(inside.map(|known| (child, known)));
            } else if !known.other_children.contains(&name) {
                let has = |known: &&Known| known.children.contains(&name);
                let near = near_children.entry((known.name, name));
                let near = *near.or_insert_with(|| self::near(name, known.children));
                found.push(Unknown::new(child, What::Element, near, has));
            }
        }
    }
    found.sort_by_key(|unknown| unknown.node.range().start);
    found
}

/// The name that an attribute is a misspelling of: of several as near, one that the element does not have.
fn near_attribute(node: Node, name: &str, known: &[&'static str]) -> Option<(&'static str, bool)> {
    let best = near(name, known)?;
    if best.1 || !node.has_attribute(best.0) {
        return Some(best);
    }
    let mut missing = known.to_vec();
    missing.retain(|known| !node.has_attribute(*known));
    let other = near(name, &missing).map(|(other, _)| (other, false));
    other.or(Some(best))
}
