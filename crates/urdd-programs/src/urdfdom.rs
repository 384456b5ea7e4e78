//! urdfdom 6.0.0 and 4.0.1, with which all of ROS and Pinocchio read URDF. A fault in a joint refuses the file; a fault
//! in a link loses that part of the link and all that is read after it.

mod parts;

use std::collections::BTreeMap;

use crate::effect::Refused;
use crate::prelude::*;
use crate::tinyxml1;
use crate::tree::Tree;

/// ROS lyrical and rolling.
pub const SIX: About = About {
    id: "urdfdom6",
    name: "ROS (urdfdom 6)",
    family: "ROS",
    version: "6.0.0",
    settings: &["ros", "lyrical", "rolling"],
    is_asked: true,
    is_for: None,
    names: Names::Exact,
    never: &[],
    read: |file, effects| model(parse(file, effects)?, Release::Six, effects).map(|_| ()),
};

/// ROS jazzy and kilted.
pub const FOUR: About = About {
    id: "urdfdom4",
    name: "ROS jazzy (urdfdom 4)",
    version: "4.0.1",
    settings: &["jazzy", "kilted"],
    read: |file, effects| model(parse(file, effects)?, Release::Four, effects).map(|_| ()),
    ..SIX
};

/// ROS noetic, humble and iron. 3.0.1 reads as 4.0.1 does, but for the parser of its XML.
pub const THREE: About = About {
    id: "urdfdom3",
    name: "ROS humble (urdfdom 3)",
    version: "3.0.1",
    settings: &["humble", "noetic", "iron"],
    read: |file, effects| {
        let tree = effects.parsed(tinyxml1::parse(file.counted))?;
        model(&tree, Release::Four, effects).map(|_| ())
    },
    ..SIX
};

const NO_COLOR: &str = "the material has no colour and no texture";

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Release {
    /// 4.0.1: URDF 1.0.
    Four,
    /// 6.0.0: URDF 1.0 to 1.2.
    Six,
}

pub struct Link<'t> {
    pub node: Node<'t>,
    /// How many visuals and collisions it reads, and whether these are all.
    pub kept: [(usize, bool); 2],
}

pub struct Joint<'t> {
    pub node: Node<'t>,
    pub kind: &'t str,
    pub parent: &'t str,
    pub child: &'t str,
}

pub struct Model<'t> {
    pub robot: Node<'t>,
    pub links: BTreeMap<&'t str, Link<'t>>,
    /// In the order of their names.
    pub joints: BTreeMap<&'t str, Joint<'t>>,
}

pub fn parse<'f>(file: &'f File<'_>, effects: &mut Effects) -> Reading<&'f Tree<'f>> {
    effects.parsed(file.document.within(tinyxml::MAX_DEPTH))
}

pub fn model<'t>(
    tree: &'t Tree<'t>,
    release: Release,
    effects: &mut Effects,
) -> Reading<Model<'t>> {
    let robot = effects.robot(tree)?;
    effects.needed(robot, "name")?;
    let minor = match robot.attribute("version") {
        None => 0,
        Some(written) => match version(&written.value) {
            Some((1, 0)) => 0,
            Some((1, minor @ 1..=2)) if release == Release::Six => minor,
            _ => return effects.refuse(written, Fault::Version((&*written.value).into())),
        },
    };
    let mut reader = UrdfdomReader { minor, effects, materials: HashMap::new() };
    reader.materials(robot);
    let links = reader.links(robot)?;
    let joints = reader.joints(robot);
    reader.effects.are_read(0)?;
    let model = Model { robot, links, joints };
    reader.tree(robot, &model)?;
    // Another program goes on with what urdfdom has, if it has all of it.
    if !reader.effects.loads() {
        return Err(Refused);
    }
    if release == Release::Four {
        formats(effects)?;
    }
    Ok(model)
}

/// Before 5.1 messages are formats of `printf`: a text in one that has `%s` or `%n` crashes.
fn formats(effects: &mut Effects) -> Reading<()> {
    let is_format = |text: &str| text.contains("%s") || text.contains("%n");
    let found = effects.kept().iter().find(|effect| {
        let is_named = effect.fault == Fault::Other(NO_COLOR) && is_format(&effect.part);
        is_named || is_format(&effect.fault.to_string())
    });
    let Some(at) = found.map(|effect| effect.at) else { return Ok(()) };
    effects.crash(at, Fault::Other("the message about it takes its `%s` or `%n` for a format"))
}

/// Two whole numbers with a point between them.
fn version(text: &str) -> Option<(u32, u32)> {
    let text = text.strip_suffix('.').filter(|text| text.contains('.')).unwrap_or(text);
    let (major, minor) = text.split_once('.')?;
    let part = |text: &str| {
        let number: i64 = text.trim_start_matches(crate::number::is_space).parse().ok()?;
        // A number of 32 bits, as it is kept.
        (number >= 0).then_some(number as u32)
    };
    Some((part(major)?, part(minor)?))
}

struct UrdfdomReader<'r> {
    /// The version of URDF is 1 and this.
    minor: u32,
    effects: &'r mut Effects,
    /// Materials that are known: the first of each name.
    materials: HashMap<String, Option<Look>>,
}

impl UrdfdomReader<'_> {
    fn tree(&mut self, robot: Node<'_>, model: &Model<'_>) -> Reading<()> {
        let before = self.effects.unread_parts();
        let mut children = HashSet::new();
        for joint in model.joints.values() {
            let ends = [("parent", joint.parent), ("child", joint.child)];
            for (name, link) in ends {
                if link.is_empty() {
                    let fault = match joint.node.child(name) {
                        None => Fault::MissingElement(name),
                        Some(end) if end.attribute("link").is_some() => Fault::Empty("link"),
                        Some(_) => Fault::Missing("link"),
                    };
                    let at = joint.node.child(name).unwrap_or(joint.node);
                    let _ = self.effects.refuse::<()>(at, fault);
                }
            }
            for (name, link) in [ends[1], ends[0]].into_iter().filter(|(_, link)| !link.is_empty())
            {
                if !model.links.contains_key(link) {
                    let at = joint.node.child(name).unwrap_or(joint.node);
                    let _ = self.effects.refuse::<()>(at, Fault::unknown("link", link));
                }
            }
            children.insert(joint.child);
        }
        self.effects.are_read(before)?;
        let roots = model.links.iter().filter(|(name, _)| !children.contains(*name));
        let mut roots: Vec<usize> = roots.map(|(_, link)| link.node.start()).collect();
        roots.sort_unstable();
        match roots[..] {
            [] => self.effects.refuse(robot, NO_ROOT),
            [_] => Ok(()),
            [_, second, ..] => self.effects.refuse(second, TWO_ROOTS),
        }
    }
}

/// A part that may be faulty: where, and why.
type PartRead<T> = Result<T, (usize, Fault)>;

fn needed<'t>(node: Node<'t>, name: &'static str) -> PartRead<&'t Attribute<'t>> {
    node.attribute(name).ok_or((node.start(), Fault::Missing(name)))
}

fn needed_element<'t>(node: Node<'t>, name: &'static str) -> PartRead<Node<'t>> {
    node.child(name).ok_or((node.start(), Fault::MissingElement(name)))
}

/// A number without anything behind it.
fn number(value: &Attribute<'_>) -> PartRead<f64> {
    let read = whole(istream(&value.value));
    read.ok_or_else(|| (value.at(), Fault::not_a_number(value)))
}

/// Numbers that may be left out.
fn numbers(node: Node<'_>, names: &[&str]) -> PartRead<()> {
    names
        .iter()
        .filter_map(|name| node.attribute(name))
        .try_for_each(|value| number(value).map(|_| ()))
}

/// Numbers with spaces, and nothing else, between them.
fn vector(value: &Attribute<'_>, count: usize) -> PartRead<Vec<f64>> {
    let numbers: Option<Vec<f64>> =
        pieces(&value.value).map(|piece| whole(istream(piece))).collect();
    match numbers {
        None => Err((value.at(), Fault::not_a_number(value))),
        Some(numbers) if numbers.len() != count => Err((value.at(), Fault::count(value, count))),
        Some(numbers) => Ok(numbers),
    }
}
