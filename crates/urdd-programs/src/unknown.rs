//! Elements and attributes that look like those of URDF, and that programs ignore: `<Visual>`, `x:origin`, `efort="3"`,
//! `<inertial>` below `<robot>`. What resembles nothing is an extension, and is not judged.

use std::cell::LazyCell;
use std::collections::HashSet;
use std::sync::LazyLock;

use urdd_xml::element::{KNOWN, Known, of};

use crate::effect::{At, Effects, KEPT, Part};
use crate::fault::Fault;
use crate::tinyxml::{Document, MOST_DEPTH};
use crate::tree::Node;

/// Elements of programs and tools, with all that is in them; some stand where URDF has other elements, or look like them.
const EXTENSIONS: &str = "transmission gazebo sensor ros2_control mujoco bullet contact frame frames verbose \
    collision_checking loop_joint self_collision_checking specular plane cdf convex deformable reduced_deformable \
    audio_source model models plugin disable_collisions chain actuator motor user-data concave simulation safety cone \
    ellipsoid type";

/// Prefixes of such elements.
const PREFIXES: &[&str] = &["xacro", "drake", "gazebo", "mujoco", "isaac", "newton", "xi"];

/// Names of attributes that say little of where they belong.
const COMMON: &[&str] = &["name", "type", "value", "link", "joint", "size", "length", "scale"];

/// The versions of URDF. `<version>` with another text is that of the file.
const VERSIONS: [&str; 3] = ["1.0", "1.1", "1.2"];

/// Which names a program takes for those of elements.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Names {
    /// As they are written.
    Exact,
    /// As they are written, in the namespace that an `xmlns` gives them.
    Expanded,
    /// In any letter case.
    AnyCase,
}

/// Something that a program ignores if it would read what is meant.
pub struct Found {
    at: usize,
    part: Part,
    fault: Fault,
    /// The elements that it is in, and what is meant. A program that never reads one of these loses nothing.
    meant: Vec<&'static str>,
}

impl Found {
    /// Adds it to what a program does that never reads some elements and attributes, in words with spaces between them.
    pub fn add(&self, never: &[&str], effects: &mut Effects) {
        let mut never = never.iter().flat_map(|words| words.split(' '));
        if !never.any(|one| self.meant.contains(&one)) {
            effects.drop(self.at, &self.part, self.fault.clone());
        }
    }
}

/// What programs ignore that take such names for those of elements, and the number of what is not kept.
pub fn find(document: &Document, names: Names) -> (Vec<Found>, usize) {
    let Ok(tree) = document.within(MOST_DEPTH) else { return (Vec::new(), 0) };
    let mut finder = Finder { names, inside: Vec::new(), found: Vec::new(), cut: 0 };
    let mut robots = tree.tops().filter(|top| top.name() == "robot");
    if let (Some(robot), Some(known)) = (robots.next(), of("robot")) {
        let place = Place { part: "robot".into(), owner: "robot".into() };
        finder.attributes(robot, known, &place.part);
        finder.children(robot, known, &place);
    }
    if let Some(second) = robots.next() {
        finder.drop(second, "robot/?".into(), Fault::Repeated("robot".into()), &[]);
    }
    (finder.found, finder.cut)
}

/// The known elements in an element, found when they are asked for.
type Beside<'t> = LazyCell<HashSet<&'static str>, Box<dyn FnOnce() -> HashSet<&'static str> + 't>>;

/// Where an element stands.
#[derive(Clone)]
struct Place {
    part: Part,
    /// The link, joint or material.
    owner: Part,
}

struct Finder {
    names: Names,
    /// The elements that are open, but for the robot.
    inside: Vec<&'static str>,
    found: Vec<Found>,
    /// Number of what is not kept.
    cut: usize,
}

impl Finder {
    /// What is in an element. Goes as deep as URDF does.
    fn children(&mut self, node: Node<'_>, known: &Known, place: &Place) {
        let (mut visuals, mut collisions) = (0, 0);
        // What stands between links is of the one before, most likely.
        let mut here = place.clone();
        let inside: Beside = LazyCell::new(Box::new(move || {
            let kinds = node.children().filter_map(|child| of(child.name()));
            kinds.map(|kind| kind.name).collect()
        }));
        for child in node.children() {
            let lower;
            let name = match self.names {
                Names::Exact | Names::Expanded => child.name(),
                Names::AnyCase => {
                    lower = child.name().to_lowercase();
                    &lower
                }
            };
            let Some(kind) = of(name).filter(|child| known.children.contains(&child.name)) else {
                self.unknown((node, &inside), child, known, &here);
                continue;
            };
            let count = match kind.name {
                "visual" => &mut visuals,
                "collision" => &mut collisions,
                _ => &mut 0,
            };
            let part = part_of(&place.part, kind.name, child, *count);
            *count += 1;
            self.inside.push(kind.name);
            let has_namespace = child.value("xmlns").is_some_and(|name| !name.is_empty());
            if has_namespace && self.names == Names::Expanded {
                let fault = Fault::Other("`xmlns` puts the element where URDF has none");
                self.drop(child, part, fault, &[]);
            } else {
                let owner = if known.name == "robot" { &part } else { &place.owner };
                let inside = Place { owner: owner.clone(), part };
                self.attributes(child, kind, &inside.part);
                self.children(child, kind, &inside);
                if known.name == "robot" {
                    here = inside;
                }
            }
            self.inside.pop();
        }
    }

    /// An element that does not stand in its parent.
    fn unknown(
        &mut self,
        (parent, inside): (Node<'_>, &Beside<'_>),
        node: Node<'_>,
        known: &Known,
        place: &Place,
    ) {
        let name = node.name();
        if is_extension(name) {
            return;
        }
        let mut children = known.children.iter().filter_map(|one| of(one));
        let like = children.find(|one| is_like(name, one.name));
        // It is meant, if it would be read.
        if let Some(like) = like.filter(|like| would_be_read(inside, like)) {
            self.add(node, &part_meant(node, like.name, known, place), name, like.name);
        } else if let Some(other) = of(name) {
            let is_default =
                name == "origin" && node.attributes().iter().all(|one| is_zero(&one.value));
            if !is_default && (other.name, known.name) != ("material", "collision") {
                let part = match other.name {
                    "link" | "joint" => part_of(&"robot".into(), name, node, 0),
                    _ => place.owner.clone(),
                };
                self.add(node, &part, name, other.name);
            }
        } else if let Some(like) = meant_attribute(parent, name, known) {
            if like != "version" || VERSIONS.contains(&node.text().unwrap_or_default().trim()) {
                self.add(node, &place.part, name, like);
            }
        } else if without_prefix(name) == name {
            self.wrapped(inside, node, known, place);
        }
    }

    /// Elements that would be read outside of an unknown element.
    fn wrapped(&mut self, beside: &Beside<'_>, wrapper: Node<'_>, known: &Known, place: &Place) {
        for inner in wrapper.children() {
            let Some(kind) = of(inner.name()) else { continue };
            let is_whole = match kind.name {
                "link" => ["inertial", "visual", "collision"]
                    .iter()
                    .any(|name| inner.child(name).is_some()),
                "joint" => inner.attribute("type").is_some() && inner.child("parent").is_some(),
                "material" => inner.attribute("name").is_some(),
                _ => true,
            };
            if is_whole && known.children.contains(&kind.name) && would_be_read(beside, kind) {
                self.add(inner, &part_meant(inner, kind.name, known, place), kind.name, kind.name);
            }
        }
    }

    fn attributes(&mut self, node: Node<'_>, known: &Known, part: &Part) {
        // Names of shapes are read by few programs, for nothing that is seen.
        let is_shape = matches!(known.name, "visual" | "collision");
        let free = |one: &&str| node.attribute(one).is_none() && !(is_shape && *one == "name");
        let missing: Vec<&'static str> = known.attributes.iter().copied().filter(free).collect();
        let text = node.text().unwrap_or_default();
        let is_number = |word: &str| word.parse::<f64>().is_ok();
        let is_value = !text.trim().is_empty() && text.split_whitespace().all(is_number);
        if is_value && !missing.is_empty() {
            let fault =
                Fault::Other("numbers are inside of the element, and not in its attributes");
            self.drop(node, part.inside("?"), fault, &missing);
        }
        for attribute in node.attributes() {
            let name = &*attribute.name;
            let has = |all: &[&str]| all.contains(&name);
            if has(known.attributes) || has(known.other_attributes) || name.starts_with("xml") {
                continue;
            }
            let is_default =
                is_zero(&attribute.value) && matches!(known.name, "origin" | "axis" | "inertia");
            if has_prefix(name) || is_default {
                continue;
            }
            let own = missing.iter().copied().find(|one| is_like(name, one));
            // The attribute of an element beside or inside.
            let is_near = |one: &Known| {
                let has = |parent: &Known| parent.children.contains(&one.name);
                let is_beside = |parent: &Known| parent.children.contains(&known.name);
                has(known) || KNOWN.iter().any(|parent| has(parent) && is_beside(parent))
            };
            let other = || {
                let mut near = KNOWN.iter().filter(|one| is_near(one));
                near.find_map(|one| one.attributes.iter().copied().find(|one| *one == name))
            };
            let other = || other().filter(|name| !COMMON.contains(name));
            if let Some(like) = own.or_else(other) {
                let fault = Fault::UnknownAttribute { name: name.into(), like };
                self.drop(attribute, part.inside("?"), fault, &[like]);
            }
        }
    }

    fn add(&mut self, node: Node<'_>, part: &Part, name: &str, like: &'static str) {
        let fault = Fault::UnknownElement { name: name.into(), like };
        self.drop(node, part.inside("?"), fault, &[like]);
    }

    fn drop(&mut self, at: impl At, part: Part, fault: Fault, meant: &[&'static str]) {
        if self.found.len() == KEPT {
            self.cut += 1;
            return;
        }
        let meant = [&self.inside, meant].concat();
        self.found.push(Found { at: at.at(), part, fault, meant });
    }
}

/// The part that an element of an unknown name, or in a wrong place, is about: a link, joint or material itself.
fn part_meant(node: Node<'_>, like: &str, known: &Known, place: &Place) -> Part {
    match (known.name, like) {
        ("robot", "link" | "joint" | "material") => part_of(&"robot".into(), like, node, 0),
        _ => place.part.clone(),
    }
}

/// The part that an element is about; that of its parent, if it is none itself.
fn part_of(parent: &Part, element: &str, node: Node<'_>, count: usize) -> Part {
    let name = node.value("name").unwrap_or_default();
    match element {
        "link" | "joint" => Part::of(element, name),
        "material" if **parent == *"robot" => Part::of("material", name),
        "visual" | "collision" => parent.inside(format_args!("{element}/{count}")),
        "origin" if !parent.starts_with("joint") => parent.clone(),
        "mass" | "inertia" | "geometry" | "color" | "texture" | "parent" | "child" | "box"
        | "sphere" | "cylinder" | "capsule" | "mesh" => parent.clone(),
        _ => parent.inside(element),
    }
}

/// The attribute that is written as an element: `<value>3</value>`.
fn meant_attribute(parent: Node<'_>, name: &str, known: &Known) -> Option<&'static str> {
    let inside = known.children.iter().filter_map(|one| of(one));
    let own = known.attributes.iter().copied();
    let inside = inside.flat_map(|one| one.attributes.iter().copied());
    let found = own.chain(inside.filter(|one| !COMMON.contains(one))).find(|one| *one == name)?;
    parent.attribute(found).is_none().then_some(found)
}

/// Whether another element of a kind is read where there may be one already.
fn would_be_read(beside: &Beside<'_>, kind: &Known) -> bool {
    let is_often = ["link", "joint", "material", "visual", "collision"].contains(&kind.name);
    is_often || !beside.contains(kind.name)
}

/// Whether a value is that of an origin which is not written.
fn is_zero(value: &str) -> bool {
    value.split_whitespace().all(|word| word.parse() == Ok(0.0))
}

fn without_prefix(name: &str) -> &str {
    name.rsplit_once(':').map_or(name, |(_, name)| name)
}

/// Whether the prefix of a name is that of a program.
fn has_prefix(name: &str) -> bool {
    name.split_once(':').is_some_and(|(prefix, _)| PREFIXES.contains(&prefix))
}

fn is_extension(name: &str) -> bool {
    static ALL: LazyLock<HashSet<&str>> = LazyLock::new(|| EXTENSIONS.split(' ').collect());
    ALL.contains(name) || has_prefix(name)
}

/// Whether a name is another with other letter case, a prefix, or one or two typing errors.
fn is_like(name: &str, known: &str) -> bool {
    const LONGEST: usize = 40;
    if name.len() > LONGEST {
        return false;
    }
    let plain = without_prefix(name).to_lowercase();
    let plain = plain.trim_matches(['_', '-', '.']);
    let errors = match known.len() {
        0..=3 => 0,
        4..=5 => 1,
        _ => 2,
    };
    plain == known
        || plain.strip_suffix('s') == Some(known)
        || is_swapped(plain, known)
        || errors > 0 && strsim::levenshtein(plain, known) <= errors
}

/// Whether two letters beside each other have changed places.
fn is_swapped(name: &str, known: &str) -> bool {
    let (name, known) = (name.as_bytes(), known.as_bytes());
    let first = name.iter().zip(known).position(|(a, b)| a != b);
    first.is_some_and(|at| match (&name[at..], &known[at..]) {
        ([a, b, rest @ ..], [c, d, other @ ..]) => (a, b, rest) == (d, c, other),
        _ => false,
    })
}
