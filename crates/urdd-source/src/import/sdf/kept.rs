//! What a URDF carries as text for Gazebo: plugins, sensors, and settings of links.

use urdd_xml::writer::Element;

use super::super::features;
use super::super::model::GazeboElement;
use super::reader::Reader;
use super::refusal::Refusal;
use super::tag::Tag;

/// Keeps an element of the model, or of a link or joint: its owner.
///
/// # Errors
/// If the account does not have its cost.
pub fn keep(reader: &mut Reader, tag: Tag, owner: Option<&str>) -> Result<(), Refusal> {
    let element = Element::of(tag.node);
    if element.has_prefix() {
        reader.tally.unread(format!("`<{}>` with prefixes in it", tag.name()));
        return Ok(());
    }
    reader.tally.count(features::KEPT);
    let gazebo = Element::new("gazebo").with_some("reference", owner).holding(element);
    let kept = GazeboElement(gazebo.fragment());
    reader.kept.push(kept, reader.gate.account()).or_else(|why| Refusal::at(tag.place(), why))
}

/// Keeps the plugins in an element.
///
/// # Errors
/// If the account does not have their cost.
pub fn keep_plugins(reader: &mut Reader, tag: Tag) -> Result<(), Refusal> {
    let mut plugins = tag.children().filter(|child| child.name() == "plugin");
    plugins.try_for_each(|plugin| keep(reader, plugin, None))
}
