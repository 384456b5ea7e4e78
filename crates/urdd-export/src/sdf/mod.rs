//! SDF, for Gazebo and Drake: links, joints, the URDD's shapes as collisions, mimics, and Drake's collision filters.
//!
//! A joint's pose is given in its parent link and a link's pose in its joint, as in a URDF. Planar and floating joints
//! are chains of simple joints with light links between them. SDF takes a link without `<inertial>` for 1 kg, so that
//! links without mass get the smallest that its reader accepts.

mod foreign;
mod gazebo;
mod joints;
mod links;
mod loops;

use crate::{Export, ExportError, Note, Subject, drake};
use gazebo::{Gazebo, Place};
use urdd_xml::writer::Element;

const GAZEBO: &str = "Gazebo knows no pairs that need no check; the links do not collide with each other there (`<self_collide>` is off). Drake reads the pairs";
const WORLD: &str = "the root link is called `world`, which is SDF's own and has neither mass nor shapes; its own are left out";

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let mut notes = Vec::new();
    let mut model = Element::new("model").with("name", model_name(subject));
    let root = subject.tree.root;
    let is_world = subject.is_world(root);
    let gazebo = Gazebo::new(subject, &mut notes);
    let mut taken = subject.names.taken.clone();
    gazebo.add("", Place::Model, &mut model, &mut taken, &mut notes);
    let mut joints = joints::joints(subject, taken, &gazebo, &mut notes)?;
    let (links, files) = links::links(subject, &joints, &gazebo, &mut notes)?;
    for (link, element) in links.into_iter().enumerate() {
        if link == root && is_world {
            notes.push(Note::Robot(WORLD));
        } else {
            model.push(element);
        }
    }
    if !is_world && !subject.is_floating {
        let name = joints.taken.free("world_fixed".to_owned());
        let world = Element::new("joint").with("name", name).with("type", "fixed");
        let parent = Element::text("parent", "world");
        let child = Element::text("child", &subject.links[root]);
        model.push(world.holding(parent).holding(child));
    }
    model.extend(std::mem::take(&mut joints.elements));
    model.extend(loops::loops(subject, &mut joints.taken, &mut notes)?);
    model.extend(drake::groups(subject, &mut joints.taken));
    if subject.disabled().next().is_some() {
        notes.push(Note::Robot(GAZEBO));
    }
    notes.extend(subject.notes());
    // Mimics came with 1.11, which libsdformat 14 (Gazebo Harmonic) and Drake read.
    let version = if joints.has_mimics { "1.11" } else { "1.9" };
    let sdf = Element::new("sdf")
        .with("version", version)
        .with("xmlns:drake", "http://drake.mit.edu")
        .holding(model);
    let what = format!("Collision geometry: {}.", subject.shapes);
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
