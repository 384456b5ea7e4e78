//! Reads models: their frames, what is nested in them, and what they include.

use nalgebra::Isometry3;

use super::super::features;
use super::super::price::{ENTRY, LETTER};
use super::super::refusal::{Fallible, Placing, at};
use super::fault::SdfFault;
use super::included::{Included, Overrides, included};
use super::joint_reader::joint;
use super::kept::{keep, keep_plugins};
use super::libsdformat::say_refusals;
use super::link_reader::link;
use super::reader::SdfReader;
use super::scene::{Node, NodeKind, Scope};
use super::tag::Tag;

/// How deep models may be nested.
const MAX_DEPTH: usize = 64;

/// The elements of a model that are read here.
const KNOWN: &[&str] =
    &["pose", "link", "joint", "frame", "model", "include", "static", "plugin", "gripper"];
/// Settings of a model that Gazebo alone reads.
const SETTINGS: &[&str] = &["self_collide", "allow_auto_disable", "enable_wind"];

/// Reads a model into the scope of another; `None` for the robot itself. Gives whether it is static.
pub fn model(
    reader: &mut SdfReader,
    tag: Tag,
    parent: Option<usize>,
    overrides: &Overrides,
    depth: usize,
) -> Fallible<bool> {
    if depth > MAX_DEPTH {
        return Err(at(tag.place(), SdfFault::Deep(MAX_DEPTH)));
    }
    let name = overrides.name.clone().map_or_else(|| tag.own_name(), Ok)?;
    let scope = enter(reader, tag, parent, &name, overrides)?;
    let is_static = overrides.is_static.unwrap_or_else(|| tag.flag("static"));
    if is_static && parent.is_some() {
        let text = format!(
            "the model `{name}` is static inside of another; it moves with what it is joined to"
        );
        reader.tally.remark(tag.place(), text);
    }
    for child in tag.children() {
        match child.name() {
            "link" => link(reader, child, scope)?,
            "joint" => joint(reader, child, scope)?,
            "frame" => frame(reader, child, scope)?,
            "model" => {
                model(reader, child, Some(scope), &Overrides::default(), depth + 1)?;
            }
            "include" => {
                let Included { file, overrides } = included(reader, child)?;
                reader.include(&file, child.place(), |reader, root| {
                    say_refusals(root, &mut reader.tally);
                    let Some(inside) = root.child("model") else {
                        let file = file.file.display().to_string();
                        return Err(at(child.place(), SdfFault::IncludesNone(file)));
                    };
                    model(reader, inside, Some(scope), &overrides, depth + 1)
                })?;
                keep_plugins(reader, child)?;
            }
            "plugin" | "gripper" => keep(reader, child, None)?,
            name if SETTINGS.contains(&name) && parent.is_none() => {
                keep(reader, child, None)?;
            }
            name if SETTINGS.contains(&name) => reader.tally.count(features::SETTINGS),
            name if KNOWN.contains(&name) => {}
            name => reader.tally.unread(format!("`<{name}>` of `<model>`")),
        }
    }
    if tag.attribute("namespace").is_some() {
        reader.tally.unread("`namespace` of `<model>`");
    }
    Ok(is_static)
}

/// Makes the scope of a model, and the node of its frame.
fn enter(
    reader: &mut SdfReader,
    tag: Tag,
    parent: Option<usize>,
    name: &str,
    overrides: &Overrides,
) -> Fallible<usize> {
    let (pose, relative_to) = overrides.pose.clone().map_or_else(|| tag.pose(), Ok)?;
    let placement = tag.attribute("placement_frame").map(str::to_owned);
    let placement = overrides.placement.clone().or(placement);
    let account = reader.gate.account();
    let scene = &mut reader.scene;
    let scope = scene.scopes.len();
    let around = parent.map(|parent| &scene.scopes[parent]);
    let prefix = around.map_or("", |around| &around.prefix);
    let names = LETTER * (prefix.len() + name.len());
    account.charge(ENTRY + names).at(tag.place())?;
    let whole = format!("{prefix}{}", name.replace("::", "/"));
    let merged_into = parent.filter(|_| overrides.is_merged);
    let (table, inner) = match (around, merged_into) {
        (Some(around), Some(_)) => (around.table, around.prefix.clone()),
        (Some(_), None) => (scene.tables.len(), format!("{whole}/")),
        (None, _) => (scene.tables.len(), String::new()),
    };
    if table == scene.tables.len() {
        scene.tables.push(Default::default());
    }
    let node = Node {
        name: whole.clone(),
        kind: NodeKind::Model(scope),
        scope: parent.unwrap_or(scope),
        pose,
        relative_to: relative_to.filter(|_| parent.is_some()),
        attached_to: None,
        placement,
        place: tag.place(),
    };
    scene.scopes.push(Scope {
        name: whole,
        prefix: inner,
        table,
        model: scene.nodes.len(),
        canonical: tag.attribute("canonical_link").map(str::to_owned),
        merged_into,
        first_link: None,
        first_model: None,
    });
    match (parent, merged_into) {
        (Some(parent), None) => {
            if !scene.add(parent, name, node) {
                let twice = SdfFault::Twice { kind: "model", name: name.to_owned() };
                return Err(at(tag.place(), twice));
            }
        }
        _ => {
            let is_moved = pose != Isometry3::identity() || node.placement.is_some();
            if parent.is_none() && is_moved {
                reader.tally.count(features::IN_WORLD);
            }
            scene.nodes.push(node);
        }
    }
    Ok(scope)
}

fn frame(reader: &mut SdfReader, tag: Tag, scope: usize) -> Fallible<()> {
    let name = tag.own_name()?;
    let whole = reader.whole_name(tag, scope, &name)?;
    let attached_to = tag.attribute("attached_to").map(str::to_owned);
    let node = Node { attached_to, ..Node::of(tag, whole, NodeKind::Frame, scope)? };
    reader.tally.count(features::FRAMES);
    reader.scene.frames.push(reader.scene.nodes.len());
    tag.unread(&["pose"], &mut reader.tally);
    match reader.scene.add(scope, &name, node) {
        true => Ok(()),
        false => Err(at(tag.place(), SdfFault::Twice { kind: "frame", name })),
    }
}
