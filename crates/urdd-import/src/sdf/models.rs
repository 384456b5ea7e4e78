//! Reads models: their frames, what is nested in them, and what they include.

use nalgebra::Isometry3;
use urdd_directory::limits::MAX_MANIFEST_BYTES;
use urdd_source::{FoundMesh, NotFound};
use urdd_xml::{Mended, parse_leniently};

use super::assets::LOOKED_AT;
use super::joint_reader::joint;
use super::libsdformat::say_refusals;
use super::link_reader::link;
use super::reader::{SdfReader, keep, keep_plugins};
use super::scene::{Node, NodeKind, Scope};
use super::tag::{Tag, is_true};
use crate::fault::{SdfFault, Unreachable};
use crate::features;
use crate::model::{ENTRY, LETTER};
use crate::place::{Fallible, Placing, at};

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
                include(reader, child, Some(scope), depth + 1)?;
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

/// The files that say which file of a folder is the model.
const MANIFESTS: &[&str] = &["model.config", "manifest.xml"];
const OF_INCLUDE: &[&str] = &["uri", "name", "pose", "placement_frame", "static", "plugin"];

/// What an `<include>` says of the model that it includes.
#[derive(Debug, Default, Clone)]
pub struct Overrides {
    pub name: Option<String>,
    pub pose: Option<(Isometry3<f64>, Option<String>)>,
    pub placement: Option<String>,
    pub is_static: Option<bool>,
    /// Its elements take part in the scope around it.
    pub is_merged: bool,
}

/// Reads the model that an `<include>` names, as [`model`] does. Gives its name, too.
pub fn include(
    reader: &mut SdfReader,
    tag: Tag,
    parent: Option<usize>,
    depth: usize,
) -> Fallible<(String, bool)> {
    let (file, overrides) = included(reader, tag)?;
    let read = reader.include(&file, tag.place(), |reader, root| {
        say_refusals(root, &mut reader.tally);
        let Some(inside) = root.child("model") else {
            let file = file.file.display().to_string();
            return Err(at(tag.place(), SdfFault::IncludesNone(file)));
        };
        let name = overrides.name.as_deref().or(inside.attribute("name")).unwrap_or_default();
        Ok((name.to_owned(), model(reader, inside, parent, &overrides, depth)?))
    })?;
    keep_plugins(reader, tag)?;
    Ok(read)
}

/// Finds the file that an `<include>` names.
///
/// # Errors
/// If there is none, or what it says is not read.
fn included(reader: &mut SdfReader, tag: Tag) -> Fallible<(FoundMesh, Overrides)> {
    let Some(uri) = tag.words("uri") else {
        return tag.lacks("uri");
    };
    if tag.child("experimental:params").is_some() {
        return Err(at(tag.place(), SdfFault::Params));
    }
    tag.unread(OF_INCLUDE, &mut reader.tally);
    let pose = tag.child("pose").map(|_| tag.pose()).transpose()?;
    reader.tally.count(features::INCLUDES);
    let overrides = Overrides {
        name: tag.words("name"),
        pose,
        placement: tag.words("placement_frame"),
        is_static: tag.words("static").map(|text| is_true(&text)),
        is_merged: tag.says("merge"),
    };
    Ok((find(reader, tag, &uri)?, overrides))
}

/// The file of a URI: itself, or the model of the folder that it names. libsdformat looks for what is behind any scheme,
/// or without one, where it looks for models.
///
/// # Errors
/// If there is none, or it may not be read.
pub fn find(reader: &SdfReader, tag: Tag, uri: &str) -> Fallible<FoundMesh> {
    let missing = match find_as(reader, tag, uri)? {
        Ok(found) => return Ok(found),
        Err(missing) => missing,
    };
    if missing.outside.is_some() {
        return Err(at(tag.place(), Unreachable::of(uri, missing)));
    }
    let bare = uri.split_once("://").map_or(uri, |(_, rest)| rest).trim_start_matches("./");
    let model = format!("model://{bare}");
    if !bare.starts_with('/')
        && model != uri
        && let Ok(found) = find_as(reader, tag, &model)?
    {
        return Ok(found);
    }
    let (uri, why) = (uri.to_owned(), missing.in_words());
    Err(at(tag.place(), SdfFault::NoInclude { uri, why }))
}

/// The file of a name as it is written.
fn find_as(reader: &SdfReader, tag: Tag, uri: &str) -> Fallible<Result<FoundMesh, NotFound>> {
    let folder = reader.folder(tag.file);
    reader.charge(LOOKED_AT * (uri.len() + folder.as_os_str().len()), tag.place())?;
    let gate = reader.gate;
    // A folder is not a file, but may have a manifest.
    let missing = match gate.find_from(uri, &folder) {
        Ok(found) => return Ok(Ok(found)),
        Err(missing) => missing,
    };
    let trimmed = uri.trim_end_matches('/');
    for manifest in MANIFESTS {
        let Ok(manifest) = gate.find_from(&format!("{trimmed}/{manifest}"), &folder) else {
            continue;
        };
        let Ok(bytes) = gate.bytes(&manifest, MAX_MANIFEST_BYTES) else { continue };
        reader.charge(bytes.len(), tag.place())?;
        let text = String::from_utf8_lossy(&bytes);
        if let Some((model, folder)) = newest(&text).zip(manifest.file.parent()) {
            let path = folder.join(model);
            let shown = path.display().to_string();
            let found = gate.at(&path).map_err(|why| Unreachable::of(&shown, why));
            return found.map(Ok).at(tag.place());
        }
    }
    Ok(Err(missing))
}

/// The file of the newest version that a manifest names.
fn newest(text: &str) -> Option<String> {
    let mended = Mended::default();
    let document = parse_leniently(text, "model", &mended).ok()?;
    let files = document.root_element().children().filter(|child| child.has_tag_name("sdf"));
    let files = files.filter_map(|file| {
        let version = file.attribute("version").unwrap_or_default().trim();
        let minor: u32 = version.strip_prefix("1.").and_then(|minor| minor.parse().ok())?;
        Some((minor, file.text()?.trim().to_owned()))
    });
    files.max_by_key(|(minor, _)| *minor).map(|(_, file)| file)
}
