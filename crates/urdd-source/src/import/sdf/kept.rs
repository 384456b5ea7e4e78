//! What a URDF carries as text for Gazebo: plugins, sensors, and settings of links.

use urdd_xml::writer::Element;

use super::super::features::{self, Tally};
use super::tag::Tag;

/// Elements `<gazebo>` of the URDF.
#[derive(Debug, Default)]
pub struct Kept {
    pub elements: Vec<String>,
}

impl Kept {
    /// Keeps an element of the model.
    pub fn of_model(&mut self, tag: Tag, tally: &mut Tally) {
        self.keep(tag, None, tally);
    }

    /// Keeps the plugins in an element.
    pub fn plugins(&mut self, tag: Tag, tally: &mut Tally) {
        for plugin in tag.children().filter(|child| child.name() == "plugin") {
            self.of_model(plugin, tally);
        }
    }

    /// Keeps an element of a link or joint.
    pub fn of(&mut self, owner: &str, tag: Tag, tally: &mut Tally) {
        self.keep(tag, Some(owner), tally);
    }

    fn keep(&mut self, tag: Tag, owner: Option<&str>, tally: &mut Tally) {
        let element = Element::of(tag.node);
        if element.has_prefix() {
            tally.unread(format!("`<{}>` with prefixes in it", tag.name()));
            return;
        }
        tally.count(features::KEPT);
        let gazebo = Element::new("gazebo").with_some("reference", owner).holding(element);
        self.elements.push(gazebo.fragment());
    }
}
