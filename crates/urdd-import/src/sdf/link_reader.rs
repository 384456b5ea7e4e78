//! Reads links.

use super::super::features;
use super::super::refusal::{Fallible, at};
use super::fault::SdfFault;
use super::inertial::inertial;
use super::kept::keep;
use super::reader::SdfReader;
use super::scene::{Link, Node, NodeKind, WORLD};
use super::shape_reader::shape;
use super::tag::Tag;

/// What Gazebo alone reads of a link, and is kept as text.
const KEPT: &[&str] = &[
    "sensor",
    "plugin",
    "gravity",
    "enable_wind",
    "self_collide",
    "kinematic",
    "must_be_base_link",
    "velocity_decay",
    "projector",
    "audio_sink",
    "audio_source",
    "battery",
    "light",
    "particle_emitter",
];

/// Reads a link into a scope.
pub fn link(reader: &mut SdfReader, tag: Tag, scope: usize) -> Fallible<()> {
    let name = tag.own_name()?;
    if name == WORLD {
        return Err(at(tag.place(), SdfFault::WorldLink(name)));
    }
    let whole = reader.whole_name(tag, scope, &name)?;
    let kind = NodeKind::Link(reader.scene.links.len());
    let node = Node::of(tag, whole.clone(), kind, scope)?;
    let index = reader.scene.nodes.len();
    if !reader.scene.add(scope, &name, node) {
        return Err(at(tag.place(), SdfFault::Twice { kind: "link", name }));
    }
    reader.tally.count(features::BODIES);
    let mut shapes = Vec::new();
    for child in tag.children() {
        match child.name() {
            "pose" | "inertial" => {}
            "visual" | "collision" => shapes.extend(shape(reader, child)?),
            name if KEPT.contains(&name) => keep(reader, child, Some((&whole, index)))?,
            name => reader.tally.unread(format!("`<{name}>` of `<link>`")),
        }
    }
    let inertial = inertial(tag, &mut reader.tally)?;
    reader.scene.links.push(Link { node: index, inertial, shapes });
    Ok(())
}
