//! An MJCF as one tree of elements: each `<include>` replaced by what is in its file, and each `<attach>` by bodies of another
//! model, with what names them.

use std::collections::{HashMap, HashSet};
use std::mem::replace;
use std::path::{Path, PathBuf};

use urdd_directory::account::Account;
use urdd_source::FoundMesh;
use urdd_source::gate::Gate;
use urdd_xml::{MAX_LEVELS, Mended, Node, parse_leniently};

use super::reading::{CLASSES, Element, missing, required, unknown};
use crate::fault::{ImportFault, MjcfFault, Unreachable};
use crate::place::{Fallible, Place, Placing, TextFile, at};

/// Models that are attached, each to the one before.
const DEEPEST: usize = 10;

/// What a description and all that it includes and attaches say.
pub struct Whole {
    /// The files, the description first.
    pub files: Vec<TextFile>,
    /// The model that each file is of: 0 is the description, others are attached.
    pub models: Vec<usize>,
    pub root: Fallible<Element>,
}

pub fn read(file: TextFile, gate: &Gate) -> Whole {
    let (path, text) = (file.path.clone(), file.text.clone());
    let (included, within) = (HashSet::new(), Vec::new());
    let mut expansion = Expansion {
        files: vec![file],
        models: vec![0],
        folder: PathBuf::new(),
        included,
        within,
        gate,
    };
    let root = expansion.model(&path, &text);
    Whole { files: expansion.files, models: expansion.models, root }
}

struct Expansion<'r> {
    files: Vec<TextFile>,
    models: Vec<usize>,
    /// That of the model that is read.
    folder: PathBuf,
    /// The names of its files, as they are written.
    included: HashSet<String>,
    /// The models that are read, each attached to the one before.
    within: Vec<PathBuf>,
    gate: &'r Gate,
}

impl Expansion<'_> {
    /// Reads a model, of which the last file is the first.
    fn model(&mut self, path: &Path, text: &str) -> Fallible<Element> {
        let file = self.files.len() - 1;
        let folder = path.parent().unwrap_or(Path::new("/")).to_owned();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let outer =
            (replace(&mut self.folder, folder), replace(&mut self.included, HashSet::from([name])));
        self.within.push(path.to_owned());
        let mut root = self.root(text, file)?;
        self.attach(&mut root)?;
        self.within.pop();
        (self.folder, self.included) = outer;
        Ok(root)
    }

    fn root(&mut self, text: &str, file: usize) -> Fallible<Element> {
        let mended = Mended::default();
        let document = parse(text, file, &mended, self.gate)?;
        let node = document.root_element();
        let place = Place { file, offset: mended.original(node.range().start) };
        let mut root = Element::new(node.tag_name().name().to_owned(), attributes(node), place);
        self.children(node, (file, &mended), 1, &mut root.children)?;
        Ok(root)
    }

    /// Puts the bodies of other models in the place of each `<attach>`.
    fn attach(&mut self, root: &mut Element) -> Fallible<()> {
        if !root.all("worldbody").any(has_attach) {
            return Ok(());
        }
        let mut models = Models::new();
        for asset in root.sections("asset").filter(|asset| asset.tag == "model") {
            let model = self.attached(asset)?;
            let name = asset.text("name").or(model.text("model")).unwrap_or_default().to_owned();
            models.insert(name, model);
        }
        let mut parts = Vec::new();
        for section in root.children.iter_mut().filter(|of| of.tag == "worldbody") {
            splice(section, 2, &models, &mut parts, self.gate.account())?;
        }
        root.children.extend(parts);
        Ok(())
    }

    /// A model that can be attached.
    fn attached(&mut self, asset: &Element) -> Fallible<Element> {
        let name = required(asset, "file")?;
        let (text, path) = self.open(name, asset.place)?;
        if self.within.len() > DEEPEST || self.within.contains(&path) {
            return Err(at(asset.place, MjcfFault::DeepModels(DEEPEST)));
        }
        let number = self.models.last().map_or(0, |model| model + 1);
        self.models.push(number);
        self.model(&path, &text)
    }

    /// Reads a file that an element names, as the last of the files.
    fn open(&mut self, name: &str, place: Place) -> Fallible<(String, PathBuf)> {
        let beside = self.files[place.file].path.parent().map(|folder| folder.join(name));
        let places = [Some(self.folder.join(name)), beside];
        let found = first(self.gate, places.into_iter().flatten(), name).at(place)?;
        let read = TextFile::included(self.gate, &found).at(place)?;
        let opened = (read.text.clone(), read.path.clone());
        self.files.push(read);
        Ok(opened)
    }

    fn children(
        &mut self,
        parent: Node<'_, '_>,
        (file, mended): (usize, &Mended),
        depth: usize,
        into: &mut Vec<Element>,
    ) -> Fallible<()> {
        for node in parent.children().filter(Node::is_element) {
            let place = Place { file, offset: mended.original(node.range().start) };
            let tag = node.tag_name().name();
            if depth > MAX_LEVELS {
                return Err(at(place, MjcfFault::TooDeep(MAX_LEVELS)));
            }
            if tag.eq_ignore_ascii_case("include") {
                self.include(node, place, depth, into)?;
                continue;
            }
            let mut element = Element::new(tag.to_owned(), attributes(node), place);
            self.children(node, (file, mended), depth + 1, &mut element.children)?;
            into.push(element);
        }
        Ok(())
    }

    fn include(
        &mut self,
        node: Node<'_, '_>,
        place: Place,
        depth: usize,
        into: &mut Vec<Element>,
    ) -> Fallible<()> {
        let name = node.attribute("file").filter(|_| !node.children().any(|of| of.is_element()));
        let name = name.ok_or_else(|| at(place, MjcfFault::Include))?;
        if !self.included.insert(name.to_owned()) {
            return Err(at(place, MjcfFault::IncludedTwice(name.to_owned())));
        }
        let (text, _) = self.open(name, place)?;
        self.models.push(self.models[place.file]);
        let file = self.files.len() - 1;
        let mended = Mended::default();
        let document = parse(&text, file, &mended, self.gate)?;
        self.children(document.root_element(), (file, &mended), depth + 1, into)
    }
}

/// The first of some places that has a file which may be read. `name` is how the description names it.
pub fn first(
    gate: &Gate,
    places: impl IntoIterator<Item = PathBuf>,
    name: &str,
) -> Result<FoundMesh, Unreachable> {
    let mut fault = None;
    for place in places {
        match gate.at(&place) {
            Ok(found) => return Ok(found),
            Err(why) if why.outside.is_some() => {
                fault.get_or_insert(why);
            }
            Err(_) => {}
        }
    }
    Err(Unreachable::of(name, fault.unwrap_or_default()))
}

fn attributes(node: Node<'_, '_>) -> Vec<(String, String)> {
    node.attributes().map(|of| (of.name().to_owned(), of.value().to_owned())).collect()
}

fn parse<'t>(
    text: &'t str,
    file: usize,
    mended: &'t Mended,
    gate: &Gate,
) -> Fallible<urdd_xml::Document<'t>> {
    let document = parse_leniently(text, "mujoco", mended).map_err(|error| {
        let place = Place { file, offset: error.offset(text) };
        at(place, ImportFault::NotXml(error.sentence(text)))
    })?;
    gate.account().charge(mended.size()).at(Place { file, offset: 0 })?;
    Ok(document)
}

/// The tag of the keys of such a model, which have the positions of all of it, and are not read.
pub const KEYS: &str = "keys of a model";
/// What holds names that are those of an element itself.
const OWN: &str = "name class childclass";
/// What holds names of others: each gets the prefix.
const OTHERS: &str = "actuator body body1 body2 cranksite geom geom1 geom2 hfield joint joint1 joint2 jointinparent \
    material mesh objname refsite site site1 site2 slidersite target tendon tendon1 tendon2 texture";
/// What an element costs, and what its prefix does.
const ELEMENT: usize = 500;
const NAMES: usize = 12;

/// Models that can be attached, by name.
pub type Models = HashMap<String, Element>;

pub fn has_attach(element: &Element) -> bool {
    element.tag == "attach" || element.children.iter().any(has_attach)
}

/// Puts the bodies of other models in the place of each `<attach>` below an element, and the rest of them into `parts`.
pub fn splice(
    element: &mut Element,
    levels: usize,
    models: &Models,
    parts: &mut Vec<Element>,
    account: &Account,
) -> Fallible<()> {
    for mut child in std::mem::take(&mut element.children) {
        if child.tag != "attach" {
            splice(&mut child, levels + 1, models, parts, account)?;
            element.children.push(child);
            continue;
        }
        let name = required(&child, "model")?;
        // It may be empty.
        let prefix = child.get("prefix").ok_or_else(|| missing(&child, "prefix"))?;
        let model = models.get(name).ok_or_else(|| unknown(&child, "model", name))?;
        account.charge(cost(model, prefix)).at(child.place)?;
        let body = child.text("body");
        let bodies = bodies(model, body, prefix, child.place);
        let bodies = bodies.ok_or_else(|| unknown(&child, "body", body.unwrap_or_default()))?;
        if levels + depth(&bodies) > MAX_LEVELS {
            return Err(at(child.place, MjcfFault::TooDeep(MAX_LEVELS)));
        }
        parts.extend(rest(model, &bodies, prefix));
        element.children.push(bodies);
    }
    Ok(())
}

/// The bodies that are attached, in a frame with their default class.
fn bodies(model: &Element, body: Option<&str>, prefix: &str, place: Place) -> Option<Element> {
    let mut frame = Element::new("frame".to_owned(), Vec::new(), place);
    let class = match body {
        None => {
            frame.children = model.sections("worldbody").cloned().collect();
            "main"
        }
        Some(body) => {
            let mut sections = model.all("worldbody");
            let (found, class) = sections.find_map(|section| find(section, body, "main"))?;
            frame.children.push(found.clone());
            class
        }
    };
    let class = format!("{prefix}{class}");
    frame.children.iter_mut().for_each(|child| rename(child, prefix));
    frame.set("childclass", class);
    Some(frame)
}

/// A body by name, with the class around it.
fn find<'e>(around: &'e Element, body: &str, class: &'e str) -> Option<(&'e Element, &'e str)> {
    let class = around.text("childclass").unwrap_or(class);
    around.children.iter().find_map(|child| match child.tag.as_str() {
        "body" if child.text("name") == Some(body) => Some((child, class)),
        _ => find(child, body, class),
    })
}

/// What else of a model comes with bodies: its assets, classes and settings, and what names these bodies alone.
fn rest(model: &Element, bodies: &Element, prefix: &str) -> Vec<Element> {
    let main = format!("{prefix}main");
    let mut classes = Element::new(CLASSES.to_owned(), Vec::new(), model.place);
    classes.children = model.all("default").cloned().collect();
    classes.children.iter_mut().for_each(|class| rename(class, prefix));
    classes.set("class", main.clone());
    let mut known = HashSet::new();
    names(bodies, &mut known);
    let mut keys = Element::new(KEYS.to_owned(), Vec::new(), model.place);
    keys.children = model.sections("keyframe").cloned().collect();
    let mut parts = vec![classes, keys];
    // Actuators name tendons.
    for tag in ["compiler", CLASSES, "asset", "tendon", "contact", "equality", "actuator", "sensor"]
    {
        for section in model.all(tag) {
            let mut section = section.clone();
            match tag {
                "compiler" => {}
                CLASSES => rename(&mut section, prefix),
                _ => {
                    section.children.retain(|child| child.tag != "model");
                    for child in &mut section.children {
                        name_by_file(child);
                        rename(child, prefix);
                        if child.get("class").is_none() {
                            child.set("class", main.clone());
                        }
                    }
                    if !matches!(tag, "asset" | "sensor") {
                        section.children.retain(|child| is_of(child, &known));
                    }
                    let tendons = section.children.iter().filter(|_| tag == "tendon");
                    known.extend(
                        tendons.filter_map(|of| Some(("tendon", of.text("name")?.to_owned()))),
                    );
                }
            }
            parts.push(section);
        }
    }
    parts
}

/// Puts a prefix before all names.
fn rename(element: &mut Element, prefix: &str) {
    for attribute in OWN.split(' ').chain(OTHERS.split_ascii_whitespace()) {
        let is_world = attribute.starts_with("body");
        let name = element.text(attribute).filter(|name| !(is_world && *name == "world"));
        if let Some(name) = name.map(|name| format!("{prefix}{name}")) {
            element.set(attribute, name);
        }
    }
    element.children.iter_mut().for_each(|child| rename(child, prefix));
}

/// Gives an asset without a name that of its file.
fn name_by_file(asset: &mut Element) {
    let stem = asset.stem().filter(|_| asset.text("name").is_none()).map(str::to_owned);
    if let Some(stem) = stem {
        asset.set("name", stem);
    }
}

/// The names of bodies and of what is in them.
fn names(element: &Element, known: &mut HashSet<(&'static str, String)>) {
    let kind = match element.tag.as_str() {
        "body" => "body",
        "joint" | "freejoint" => "joint",
        "geom" => "geom",
        "site" => "site",
        _ => "",
    };
    known.extend(element.text("name").map(|name| (kind, name.to_owned())));
    element.children.iter().for_each(|child| names(child, known));
}

/// Whether all that an element and its children name is known.
fn is_of(element: &Element, known: &HashSet<(&'static str, String)>) -> bool {
    let kinds = ["body", "joint", "geom", "site", "tendon"];
    let own = OTHERS.split_ascii_whitespace().all(|attribute| {
        let kind = kinds.into_iter().find(|kind| attribute.contains(kind));
        match (kind, element.text(attribute)) {
            (Some("body"), Some("world")) | (_, None) | (None, _) => true,
            (Some(kind), Some(name)) => known.contains(&(kind, name.to_owned())),
        }
    });
    own && element.children.iter().all(|child| is_of(child, known))
}

fn cost(element: &Element, prefix: &str) -> usize {
    let children: usize = element.children.iter().map(|child| cost(child, prefix)).sum();
    ELEMENT + 2 * element.length() + NAMES * prefix.len() + children
}

fn depth(element: &Element) -> usize {
    1 + element.children.iter().map(depth).max().unwrap_or(0)
}
