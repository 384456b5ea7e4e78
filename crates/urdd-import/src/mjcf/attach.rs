//! `<attach>`: bodies of another model, with what names them.

use std::collections::{HashMap, HashSet};

use urdd_directory::account::Account;
use urdd_xml::MAX_LEVELS;

use super::super::place::Place;
use super::super::refusal::{Fallible, Placing, at};
use super::defaults::CLASSES;
use super::element::Element;
use super::fault::MjcfFault;
use super::reading::{missing, required, unknown};

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

/// Whether there is an `<attach>` in an element.
pub fn is_in(element: &Element) -> bool {
    element.tag == "attach" || element.children.iter().any(is_in)
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
