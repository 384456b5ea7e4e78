//! Composes one URDF from all parts.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::error::CombineError;
use super::frozen::origin_text;
use super::names::escaped;
use super::part::Loaded;
use super::recipe::{JointDescription, Part, Recipe, Word};
use super::recipe_fault::{RecipeFault, joint_type_word};
use super::rewrite::Rewritten;
use super::trim::Trim;
use urdd_format::urdf::Material;
use urdd_source::origin::has_quaternions;
use urdd_xml::number::numbers;

/// A loaded part and the selection of what is kept of it.
pub(super) struct Taken<'a> {
    pub part: &'a Part,
    /// Shared by all parts with the same source.
    pub loaded: Rc<Loaded>,
    pub trim: Trim,
}

impl Taken<'_> {
    /// A name of the part as it appears in the combined robot.
    pub fn renamed(&self, name: &str) -> String {
        format!("{}{name}", self.part.prefix.text)
    }

    /// The name of its root link in the combined robot.
    pub fn root(&self) -> String {
        self.renamed(&self.loaded.robot.links[self.trim.root].name)
    }
}

/// The URDF version of the combined robot: the highest of all parts.
pub(super) fn version(parts: &[Taken]) -> Option<String> {
    let number = |version: &str| -> Option<(u64, u64)> {
        let (major, minor) = version.trim().split_once('.')?;
        Some((major.parse().ok()?, minor.parse().ok()?))
    };
    let versions = parts.iter().filter_map(|part| part.loaded.robot.version.clone());
    versions.max_by_key(|version| (has_quaternions(Some(version)), number(version)))
}

/// What holds a part.
pub(super) struct Held<'a> {
    /// The holding part; `None` for the base.
    pub part: Option<usize>,
    /// Its link, by the name in the combined robot.
    pub link: String,
    pub joint: &'a JointDescription,
}

/// What holds a part; `None` for a root part without a base.
///
/// # Errors
/// If its attachment does not name a part; an earlier check rules this out.
pub(super) fn held<'a>(
    recipe: &'a Recipe,
    parts: &[Taken<'a>],
    taken: &Taken<'a>,
) -> Result<Option<Held<'a>>, CombineError> {
    let Some(attach) = &taken.part.attach else {
        return Ok(recipe.base.as_ref().map(|base| Held {
            part: None,
            link: base.link.text.clone(),
            joint: &base.joint,
        }));
    };
    let (part, link) = recipe.target(&attach.to)?;
    let link = part.map_or_else(|| link.to_owned(), |part| parts[part].renamed(link));
    let joint = &attach.joint;
    Ok(Some(Held { part, link, joint }))
}

/// Checks that names are unique. Returns, for each part, the indices of top-level materials that an earlier part also
/// has.
///
/// # Errors
/// The first name that occurs twice.
pub(super) fn check_names(
    recipe: &Recipe,
    parts: &[Taken],
) -> Result<Vec<BTreeSet<usize>>, CombineError> {
    let mut known: BTreeMap<(&'static str, String), String> = BTreeMap::new();
    let mut add = |what, name: String, from: &str, at: &Word| {
        let before = known.insert((what, name.clone()), from.to_owned());
        clash(recipe, what, &name, before, from.to_owned(), at)
    };
    if let Some(base) = &recipe.base {
        add("link", base.link.text.clone(), "`[base]`", &base.link)?;
    }
    for taken in parts {
        let (part, robot) = (taken.part, &taken.loaded.robot);
        let from = format!("part `{}`", part.id.text);
        for (idx, link) in robot.links.iter().enumerate() {
            if taken.trim.keeps_link(idx) {
                add("link", taken.renamed(&link.name), &from, &part.id)?;
            }
        }
        for (idx, joint) in robot.joints.iter().enumerate() {
            if taken.trim.keeps_joint(idx) {
                add("joint", taken.renamed(&joint.name), &from, &part.id)?;
            }
        }
        let attach = part.attach.as_ref().map(|attach| &attach.joint.name);
        let base = recipe.base.as_ref().map(|base| &base.joint.name);
        if let Some(name) = attach.or(base) {
            let of = format!("the joint that attaches part `{}`", part.id.text);
            add("joint", name.text.clone(), &of, name)?;
        }
    }
    materials(recipe, parts)
}

fn clash(
    recipe: &Recipe,
    what: &'static str,
    name: &str,
    before: Option<String>,
    second: String,
    at: &Word,
) -> Result<(), CombineError> {
    let Some(first) = before else {
        return Ok(());
    };
    let name = name.to_owned();
    let fault = RecipeFault::Clash { what, name, first, second };
    Err(recipe.refused(at, fault))
}

/// Materials with the same name must look the same in all parts. Within a part, the first counts.
fn materials(recipe: &Recipe, parts: &[Taken]) -> Result<Vec<BTreeSet<usize>>, CombineError> {
    let mut known: BTreeMap<String, (usize, &Material)> = BTreeMap::new();
    let mut repeated = Vec::new();
    for (idx, taken) in parts.iter().enumerate() {
        let robot = &taken.loaded.robot;
        let visuals = robot.links.iter().flat_map(|link| &link.visual);
        let inline = visuals.filter_map(|visual| visual.material.as_ref());
        let top = robot.materials.iter().enumerate();
        let all = top.map(|(place, of)| (Some(place), of)).chain(inline.map(|of| (None, of)));
        let mut again = BTreeSet::new();
        for (place, material) in all {
            let Some(name) = &material.name else {
                continue;
            };
            let has_look = material.color.is_some() || material.texture.is_some();
            if name.is_empty() || !has_look {
                continue;
            }
            let name = taken.renamed(name);
            let Some((of, first)) = known.get(&name).filter(|(of, _)| *of != idx) else {
                known.entry(name).or_insert((idx, material));
                continue;
            };
            if (&first.color, &first.texture) != (&material.color, &material.texture) {
                let first = format!("part `{}`", parts[*of].part.id.text);
                let second = format!("part `{}`, where it looks different", taken.part.id.text);
                let at = &taken.part.id;
                clash(recipe, "material", &name, Some(first), second, at)?;
                continue;
            }
            again.extend(place);
        }
        repeated.push(again);
    }
    Ok(repeated)
}

/// Writes the text of the URDF.
///
/// # Errors
/// If parts use one XML prefix for different namespaces, or the same name for transmissions and the like.
pub(super) fn urdf(
    recipe: &Recipe,
    parts: &[Taken],
    rewritten: &[Rewritten],
) -> Result<String, CombineError> {
    let mut namespaces: BTreeMap<&str, &str> = BTreeMap::new();
    let mut own: BTreeMap<&str, &Taken> = BTreeMap::new();
    for (taken, text) in parts.iter().zip(rewritten) {
        for (prefix, uri) in &text.namespaces {
            let first = *namespaces.entry(prefix).or_insert(uri);
            if first != uri {
                let fault = RecipeFault::Namespace {
                    prefix: prefix.clone(),
                    first: first.to_owned(),
                    second: uri.clone(),
                    part: taken.part.id.text.clone(),
                };
                return Err(recipe.refused(&taken.part.id, fault));
            }
        }
        for name in &text.own {
            let before = own.insert(name, taken);
            // Duplicates within one part are allowed.
            let before = before.filter(|before| before.part.id != taken.part.id);
            let first = before.map(|before| format!("part `{}`", before.part.id.text));
            let second = format!("part `{}`", taken.part.id.text);
            let what = "transmission or ros2_control";
            clash(recipe, what, name, first, second, &taken.part.id)?;
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
        text += &format!("  <link name=\"{}\"/>\n", escaped(&base.link.text));
    }
    for (taken, rewritten) in parts.iter().zip(rewritten) {
        if let Some(held) = held(recipe, parts, taken)? {
            text += &joint(held.joint, &held.link, &taken.root());
        }
        text += &rewritten.inner;
        text.push('\n');
    }
    text += "</robot>\n";
    Ok(text)
}

fn joint(described: &JointDescription, parent: &str, child: &str) -> String {
    let mut text = format!(
        "  <joint name=\"{}\" type=\"{}\">\n    <parent link=\"{}\"/>\n    <child link=\"{}\"/>\n    {}\n",
        escaped(&described.name.text),
        joint_type_word(described.joint_type),
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
