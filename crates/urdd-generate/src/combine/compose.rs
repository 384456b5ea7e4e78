//! Composes one URDF from all parts, and records how in the `composition_module`.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::rc::Rc;

use super::error::Result;
use super::names::escaped;
use super::part::Loaded;
use super::recipe::{Attachment, Part, Recipe, Word};
use super::rewrite::Rewritten;
use super::trim::{Trim, origin_text};
use urdd_format::composition::{
    CompositionBase, CompositionModule, CompositionPart, FrozenJoint, PartAttachment, PartJoint,
    PartLink, PartSource,
};
use urdd_format::index::{JointIdx, LinkIdx, RobotIdx};
use urdd_format::urdf::{Joint, Link, Material, UrdfModule};
use urdd_source::origin::has_quaternions;
use urdd_xml::number::numbers;

/// A part of the combined robot: what is loaded, and what is kept of it.
pub(super) struct Member<'a> {
    pub part: &'a Part,
    /// Shared by all parts with the same source.
    pub loaded: Rc<Loaded>,
    pub trim: Trim,
}

impl Member<'_> {
    pub fn renamed(&self, name: &str) -> String {
        format!("{}{name}", self.part.prefix.text)
    }

    /// The name of one of its links in the combined robot.
    /// Fails if the part has no such link, or it is dropped.
    pub fn link(&self, recipe: &Recipe, name: &str, at: &Word) -> Result<String> {
        let part = &self.part.id.text;
        let idx = recipe.find(part, "link", &self.loaded.links, name, at)?;
        let Some(with) = self.trim.dropped_links[idx] else { return Ok(self.renamed(name)) };
        let with = &self.part.drop[with].text;
        let fault = format!("the link `{name}` of part `{part}` is dropped, with `{with}`");
        Err(recipe.refused(at, fault))
    }

    pub fn is_urdd(&self) -> bool {
        matches!(self.loaded.source, PartSource::Urdd(_))
    }

    pub fn kept_links(&self) -> impl Iterator<Item = &Link> {
        let links = self.loaded.robot.links.iter().enumerate();
        links.filter(|(idx, _)| self.trim.keeps_link(*idx)).map(|(_, link)| link)
    }

    fn kept_joints(&self) -> impl Iterator<Item = &Joint> {
        let joints = self.loaded.robot.joints.iter().enumerate();
        joints.filter(|(idx, _)| self.trim.keeps_joint(*idx)).map(|(_, joint)| joint)
    }

    /// The name of its root link in the combined robot.
    pub fn root(&self) -> String {
        self.renamed(&self.loaded.robot.links[self.trim.root].name)
    }
}

/// The URDF version of the combined robot: the highest of all parts.
pub(super) fn version(parts: &[Member]) -> Option<String> {
    let number = |version: &str| -> Option<(u64, u64)> {
        let (major, minor) = version.trim().split_once('.')?;
        Some((major.parse().ok()?, minor.parse().ok()?))
    };
    let versions = parts.iter().filter_map(|part| part.loaded.robot.version.clone());
    versions.max_by_key(|version| (has_quaternions(Some(version)), number(version)))
}

pub(super) struct Held<'a> {
    /// The holding part; `None` for the base.
    pub part: Option<usize>,
    /// Its link, by the name in the combined robot.
    pub link: String,
    pub joint: &'a Attachment,
}

/// What holds each part; `None` for a root part without a base.
pub(super) fn holders<'a>(
    recipe: &'a Recipe,
    parts: &[Member<'a>],
) -> Result<Vec<Option<Held<'a>>>> {
    let holder = |member: &Member<'a>| {
        let Some(joint) = &member.part.attach else {
            let base = recipe.base.as_ref();
            return Ok(base.map(|joint| Held { part: None, link: joint.to.text.clone(), joint }));
        };
        let (part, link) = recipe.target(&joint.to)?;
        let link = match part {
            Some(part) => parts[part].link(recipe, link, &joint.to)?,
            None => link.to_owned(),
        };
        Ok(Some(Held { part, link, joint }))
    };
    parts.iter().map(holder).collect()
}

/// Checks that names are unique. Returns, for each part, the indices of top-level materials that an earlier part also
/// has.
pub(super) fn check_names(recipe: &Recipe, parts: &[Member]) -> Result<Vec<BTreeSet<usize>>> {
    let mut known: BTreeMap<(&'static str, String), String> = BTreeMap::new();
    let mut add = |what, name: String, from: &str, at: &Word| {
        let before = known.insert((what, name.clone()), from.to_owned());
        clash(recipe, what, &name, before, from.to_owned(), at)
    };
    if let Some(base) = &recipe.base {
        add("link", base.to.text.clone(), "`[base]`", &base.to)?;
    }
    for member in parts {
        let part = member.part;
        let from = format!("part `{}`", part.id.text);
        for link in member.kept_links() {
            add("link", member.renamed(&link.name), &from, &part.id)?;
        }
        for joint in member.kept_joints() {
            add("joint", member.renamed(&joint.name), &from, &part.id)?;
        }
        if let Some(attach) = part.attach.as_ref().or(recipe.base.as_ref()) {
            let of = format!("the joint that attaches part `{}`", part.id.text);
            add("joint", attach.name.text.clone(), &of, &attach.name)?;
        }
    }
    materials(recipe, parts)
}

fn clash(
    recipe: &Recipe,
    what: &str,
    name: &str,
    before: Option<String>,
    second: String,
    at: &Word,
) -> Result<()> {
    let Some(first) = before else { return Ok(()) };
    let fault = format!(
        "the {what} `{name}` comes from {first} and from {second}; give one of them a `prefix`, or another name"
    );
    Err(recipe.refused(at, fault))
}

/// Materials with the same name must look the same in all parts. Within a part, the first counts.
fn materials(recipe: &Recipe, parts: &[Member]) -> Result<Vec<BTreeSet<usize>>> {
    let mut known: BTreeMap<String, (usize, &Material)> = BTreeMap::new();
    let mut repeated = Vec::new();
    for (idx, member) in parts.iter().enumerate() {
        let robot = &member.loaded.robot;
        let visuals = robot.links.iter().flat_map(|link| &link.visual);
        let inline = visuals.filter_map(|visual| visual.material.as_ref());
        let top = robot.materials.iter().enumerate();
        let all = top.map(|(place, of)| (Some(place), of)).chain(inline.map(|of| (None, of)));
        let mut again = BTreeSet::new();
        for (place, material) in all {
            let Some(name) = &material.name else { continue };
            let has_look = material.color.is_some() || material.texture.is_some();
            if name.is_empty() || !has_look {
                continue;
            }
            let name = member.renamed(name);
            let Some((of, first)) = known.get(&name).filter(|(of, _)| *of != idx) else {
                known.entry(name).or_insert((idx, material));
                continue;
            };
            if (&first.color, &first.texture) != (&material.color, &material.texture) {
                let first = format!("part `{}`", parts[*of].part.id.text);
                let second = format!("part `{}`, where it looks different", member.part.id.text);
                clash(recipe, "material", &name, Some(first), second, &member.part.id)?;
                continue;
            }
            again.extend(place);
        }
        repeated.push(again);
    }
    Ok(repeated)
}

/// Writes the text of the URDF.
/// Fails if parts use one XML prefix for different namespaces, or the same name for transmissions and the like.
pub(super) fn urdf(
    recipe: &Recipe,
    parts: &[Member],
    holders: &[Option<Held>],
    rewritten: &[Rewritten],
) -> Result<String> {
    let mut namespaces: BTreeMap<&str, &str> = BTreeMap::new();
    let mut own: BTreeMap<&str, &Member> = BTreeMap::new();
    for (member, text) in parts.iter().zip(rewritten) {
        for (prefix, uri) in &text.namespaces {
            let first = *namespaces.entry(prefix).or_insert(uri);
            if first != uri {
                let part = &member.part.id;
                let fault = format!(
                    "the XML prefix `{prefix}` means `{first}` in one part and `{uri}` in part `{}`; rename one of them in its URDF",
                    part.text
                );
                return Err(recipe.refused(part, fault));
            }
        }
        for name in &text.own {
            let before = own.insert(name, member);
            // Duplicates within one part are allowed.
            let before = before.filter(|before| before.part.id != member.part.id);
            let first = before.map(|before| format!("part `{}`", before.part.id.text));
            let second = format!("part `{}`", member.part.id.text);
            clash(recipe, "transmission or ros2_control", name, first, second, &member.part.id)?;
        }
    }
    let mut text =
        String::from("<?xml version=\"1.0\"?>\n<!-- Put together by urdd combine. -->\n");
    text += &format!("<robot name=\"{}\"", escaped(&recipe.name.text));
    if let Some(version) = version(parts) {
        text += &format!(" version=\"{}\"", escaped(&version));
    }
    for (prefix, uri) in namespaces {
        let colon = if prefix.is_empty() { "" } else { ":" };
        text += &format!(" xmlns{colon}{prefix}=\"{}\"", escaped(uri));
    }
    text += ">\n";
    if let Some(base) = &recipe.base {
        text += &format!("  <link name=\"{}\"/>\n", escaped(&base.to.text));
    }
    for ((member, held), rewritten) in parts.iter().zip(holders).zip(rewritten) {
        if let Some(held) = held {
            text += &joint(held.joint, &held.link, &member.root());
        }
        text += &rewritten.inner;
        text.push('\n');
    }
    text += "</robot>\n";
    Ok(text)
}

fn joint(described: &Attachment, parent: &str, child: &str) -> String {
    let mut text = format!(
        "  <joint name=\"{}\" type=\"{}\">\n    <parent link=\"{}\"/>\n    <child link=\"{}\"/>\n    {}\n",
        escaped(&described.name.text),
        described.joint.text,
        escaped(parent),
        escaped(child),
        origin_text(described.xyz, described.rpy),
    );
    if let Some(axis) = described.axis {
        text += &format!("    <axis xyz=\"{}\"/>\n", numbers(&axis));
    }
    if let Some(limit) = &described.limit {
        let numbers_of = [
            ("lower", limit.lower),
            ("upper", limit.upper),
            ("effort", limit.effort),
            ("velocity", limit.velocity),
        ];
        let said = numbers_of
            .iter()
            .filter_map(|(key, value)| Some(format!(" {key}=\"{}\"", numbers(&[(*value)?]))));
        text += &format!("    <limit{}/>\n", said.collect::<String>());
    }
    text + "  </joint>\n"
}

pub(super) fn composition(
    recipe: &Recipe,
    parts: &[Member],
    holders: &[Option<Held>],
    robot: &UrdfModule,
) -> CompositionModule {
    let links: HashMap<&str, u32> =
        (robot.links.iter().map(|link| link.name.as_str())).zip(0..).collect();
    let joints: HashMap<&str, u32> =
        (robot.joints.iter().map(|joint| joint.name.as_str())).zip(0..).collect();
    let link = |name: &str| LinkIdx(links.get(name).copied().unwrap_or_default());
    let joint = |name: &str| JointIdx(joints.get(name).copied().unwrap_or_default());
    let mut made = Vec::new();
    for (member, held) in parts.iter().zip(holders) {
        let (part, of) = (member.part, &member.loaded.robot);
        let attachment = held.as_ref().map(|held| PartAttachment {
            part_idx: held.part.map(|part| RobotIdx(part as u32)),
            link_idx: link(&held.link),
            joint_idx: joint(&held.joint.name.text),
        });
        let dropped = |names: &mut dyn Iterator<Item = &String>, dropped: &[Option<usize>]| {
            let names = names.zip(dropped).filter(|(_, with)| with.is_some());
            names.map(|(name, _)| name.clone()).collect()
        };
        let frozen = member.trim.frozen.iter().map(|(idx, position)| FrozenJoint {
            joint_idx: joint(&member.renamed(&of.joints[*idx].name)),
            position: position.iter().map(|value| value + 0.0).collect(),
        });
        made.push(CompositionPart {
            id: part.id.text.clone(),
            name: of.name.clone(),
            source: member.loaded.source.clone(),
            prefix: part.prefix.text.clone(),
            links: (member.kept_links().map(|link| &link.name))
                .map(|name| PartLink { name: name.clone(), link_idx: link(&member.renamed(name)) })
                .collect(),
            joints: (member.kept_joints().map(|joint| &joint.name))
                .map(|name| PartJoint {
                    name: name.clone(),
                    joint_idx: joint(&member.renamed(name)),
                })
                .collect(),
            dropped_links: dropped(
                &mut of.links.iter().map(|link| &link.name),
                &member.trim.dropped_links,
            ),
            dropped_joints: dropped(
                &mut of.joints.iter().map(|joint| &joint.name),
                &member.trim.dropped_joints,
            ),
            frozen_joints: frozen.collect(),
            attachment,
            composition: member.loaded.composition.clone().map(Into::into),
        });
    }
    let base = recipe.base.as_ref().map(|base| CompositionBase { link_idx: link(&base.to.text) });
    CompositionModule { base, parts: made }
}
