//! SDF, for Gazebo and Drake: links, joints, the URDD's shapes as collisions, mimics, and Drake's collision filters.
//!
//! A joint's pose is given in its parent link and a link's pose in its joint, as in a URDF. Planar and floating joints
//! are chains of simple joints with light links between them. SDF takes a link without `<inertial>` for 1 kg, so that
//! links without mass get the smallest that its reader accepts.

mod joints;
mod links;

use super::drake;
use super::element::Element;
use super::error::{ExportError, Note};
use super::names::check_unique;
use super::output::Export;
use super::subject::Subject;

const GAZEBO: &str = "Gazebo knows no pairs that need no check; the links do not collide with each other there (`<self_collide>` is off). Drake reads the pairs";
const WORLD: &str = "the root link is called `world`, which is SDF's own and has neither mass nor shapes; its own are left out";

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let mut notes = Vec::new();
    let mut model = Element::new("model").with("name", model_name(subject));
    let root = subject.tree.root;
    let is_world = subject.is_world(root);
    let joints = joints::joints(subject, &mut notes);
    let (links, files) = links::links(subject, &joints, &mut notes)?;
    for (link, element) in links.into_iter().enumerate() {
        if link == root && is_world {
            notes.push(Note::Robot(WORLD));
        } else {
            model.push(element);
        }
    }
    let between = joints.links.iter().map(|(name, _)| name);
    let names = between.chain(&joints.names).map(String::as_str);
    let names = names.chain(subject.links.iter().map(String::as_str));
    let has_mimics = joints.has_mimics;
    // Links and joints are frames of the model: all have names of their own.
    if !is_world && !subject.options.floating() {
        let world = Element::new("joint").with("name", joints::WORLD).with("type", "fixed");
        let parent = Element::new("parent").containing("world");
        let child = Element::new("child").containing(&subject.links[root]);
        model.push(world.holding(parent).holding(child));
        check_unique(subject.format, "frame", names.chain([joints::WORLD]))?;
    } else {
        check_unique(subject.format, "frame", names)?;
    }
    for element in joints.elements {
        model.push(element);
    }
    for group in drake::groups(subject) {
        model.push(group);
    }
    if subject.disabled().next().is_some() {
        notes.push(Note::Robot(GAZEBO));
    }
    notes.extend(subject.notes());
    // Mimics came with 1.11, which libsdformat 14 (Gazebo Harmonic) and Drake read.
    let version = if has_mimics { "1.11" } else { "1.9" };
    let sdf = Element::new("sdf")
        .with("version", version)
        .with("xmlns:drake", "http://drake.mit.edu")
        .holding(model);
    let what = format!("Collision geometry: {}.", subject.options.shapes);
    let text = sdf.document(&subject.comments(what, &notes)?);
    Ok(Export::of(text, files, notes))
}

/// SDF needs a name for a model.
fn model_name<'a>(subject: &'a Subject) -> &'a str {
    match subject.urdf.name.as_str() {
        "" => "robot",
        name => name,
    }
}
