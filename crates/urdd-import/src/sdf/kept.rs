//! What a URDF carries as text for Gazebo: plugins, sensors, and settings of links.

use nalgebra::Isometry3;

use super::super::features;
use super::super::model::GazeboElement;
use super::super::place::Place;
use super::super::price::LETTER;
use super::super::refusal::{Fallible, Placing};
use super::poses::Frames;
use super::reader::SdfReader;
use super::scene::{Posed, Scene};
use super::tag::Tag;
use urdd_kinematics::rotation::to_rpy;
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;

/// What an element of a link or joint is kept for: its name in the URDF, and its node.
pub type Owner<'n> = (&'n str, usize);

/// Keeps an element of the model, or of a link or joint.
pub fn keep(reader: &mut SdfReader, tag: Tag, owner: Option<Owner>) -> Fallible<()> {
    let mut element = Element::of(tag.node);
    if element.has_prefix() {
        reader.tally.unread(format!("`<{}>` with prefixes in it", tag.name()));
        return Ok(());
    }
    reader.tally.count(features::KEPT);
    let (pose, relative_to) = match owner {
        Some(_) => tag.pose()?,
        None => (Isometry3::identity(), None),
    };
    match (owner, relative_to) {
        (Some((name, node)), Some(relative_to)) => {
            let owner = name.to_owned();
            let (pose, place) = ((pose, relative_to), tag.place());
            reader.charge(element.fragment().len() + LETTER * name.len(), place)?;
            reader.posed.push(Posed { element, owner, node, pose, place });
            Ok(())
        }
        _ => {
            // Where it is empty, other versions and programs take it for a name.
            if let Some(pose) = element.child_mut("pose") {
                pose.set("frame", None);
                pose.set("relative_to", None);
            }
            push(reader, element, owner.map(|(name, _)| name), tag.place())
        }
    }
}

/// Keeps the plugins in an element.
pub fn keep_plugins(reader: &mut SdfReader, tag: Tag) -> Fallible<()> {
    let mut plugins = tag.children().filter(|child| child.name() == "plugin");
    plugins.try_for_each(|plugin| keep(reader, plugin, None))
}

/// Puts elements into the frames of their links and joints, which a URDF has.
pub fn keep_posed(reader: &mut SdfReader, scene: &Scene, frames: &Frames) -> Fallible<()> {
    for Posed { mut element, owner, node, pose: (pose, name), place } in
        std::mem::take(&mut reader.posed)
    {
        match scene.find(scene.nodes[node].scope, &name) {
            Some(base) => {
                let pose = frames.relative(base, node) * pose;
                let rpy = to_rpy(pose.rotation.to_rotation_matrix().matrix());
                let place = [pose.translation.vector.as_slice(), &rpy].concat();
                element.remove("pose");
                element.say("pose", &numbers(&place));
            }
            None => {
                let text =
                    format!("the pose of this `<{}>` names no frame: `{name}`", element.name());
                reader.tally.remark(place, text);
            }
        }
        push(reader, element, Some(&owner), place)?;
    }
    Ok(())
}

/// Keeps that the robot is static. libsdformat takes the word of the last `<gazebo>` for it, and a missing one for no.
pub fn keep_static(reader: &mut SdfReader, place: Place) -> Fallible<()> {
    reader.tally.count(features::KEPT);
    push(reader, Element::text("static", "true"), None, place)
}

fn push(
    reader: &mut SdfReader,
    element: Element,
    owner: Option<&str>,
    place: Place,
) -> Fallible<()> {
    let gazebo = Element::new("gazebo").with_some("reference", owner).holding(element);
    let kept = GazeboElement(gazebo.fragment());
    reader.kept.push(kept, reader.gate.account()).at(place)
}
