//! Elements of the source that go into an SDF as they are, but for what makes libsdformat or Drake refuse the whole file.
//! What is inside a `<plugin>` is the plugin's own: nobody reads it.

use std::collections::BTreeSet;

use crate::Format;
use crate::names::one;
use urdd_xml::writer::Element;

/// Elements that SDF gives a name.
const NAMED: [&str; 13] = [
    "battery",
    "camera",
    "collision",
    "frame",
    "gripper",
    "joint",
    "light",
    "link",
    "model",
    "particle_emitter",
    "projector",
    "sensor",
    "visual",
];

/// Those that need a type.
const TYPED: [&str; 4] = ["joint", "light", "particle_emitter", "sensor"];

/// Elements in which SDF has no plugin: Drake refuses one there, and Gazebo starts none.
const WITHOUT_PLUGINS: [&str; 3] = ["link", "joint", "collision"];

const NAMELESS: &str =
    "SDF needs its name, which is neither empty nor `world` and has no `__` at both ends";
const TYPELESS: &str = "SDF needs its type";
const PLUGIN: &str = "SDF needs its name and its file";
const POSE: &str = "SDF needs 6 numbers, or 7 of a quaternion";

const DELIMITER: &str = "libsdformat refuses `::` in names: elements of `<gazebo>` that have such a name, and that SDF does not define, are left out";
const RENAMED: &str = "libsdformat refuses `::` in names: those of sensors and the like in `<gazebo>` elements have `__` instead";
const MOVED: &str = "SDF has no plugins of links, joints and collisions: those in such `<gazebo>` elements are plugins of the model";
const FRAME: &str =
    "`frame` of a `<pose>` is left out: libsdformat does not read it, and Drake refuses the file";

/// An element that is left out, and why.
type Fault = (&'static str, &'static str);

/// What became of elements.
#[derive(Default)]
pub(super) struct Mended {
    pub faults: BTreeSet<Fault>,
    /// What else is other than in the source.
    pub changes: BTreeSet<&'static str>,
    /// Plugins of what has none.
    pub plugins: Vec<Element>,
}

impl Mended {
    /// Mends an element and what is in it; whether it stays where it is.
    pub fn mend(&mut self, element: &mut Element) -> bool {
        match self.own(element) {
            Ok(is_kept) => {
                if is_kept && element.name() != "plugin" {
                    self.mend_inside(element);
                }
                is_kept
            }
            Err(fault) => {
                self.faults.insert(fault);
                false
            }
        }
    }

    /// Mends what is in an element.
    pub fn mend_inside(&mut self, element: &mut Element) {
        let has_plugins = !WITHOUT_PLUGINS.contains(&element.name());
        element.retain(|child| {
            if child.name() == "plugin" && !has_plugins {
                self.move_plugin(child);
                return false;
            }
            self.mend(child)
        });
    }

    /// Mends a plugin that the model gets.
    pub fn move_plugin(&mut self, plugin: &mut Element) {
        if self.mend(plugin) {
            self.changes.insert(MOVED);
            self.plugins.push(plugin.clone());
        }
    }

    /// Mends an element itself; whether it is kept, or what is wrong with it.
    fn own(&mut self, element: &mut Element) -> Result<bool, Fault> {
        let is_filled = |key| element.attribute(key).is_some_and(|value| !value.trim().is_empty());
        match element.name() {
            "plugin" if is_filled("name") && is_filled("filename") => return Ok(true),
            "plugin" => return Err(("plugin", PLUGIN)),
            "pose" => return self.pose(element),
            _ => {}
        }
        // What has text refers to another element, as a contact sensor's `<collision>` does.
        let refers = !element.own_text().is_empty();
        if let Some(typed) = TYPED.iter().find(|typed| **typed == element.name())
            && !refers
            && !is_filled("type")
        {
            return Err((typed, TYPELESS));
        }
        let named = NAMED.iter().find(|named| **named == element.name());
        let given = element.attribute("name").unwrap_or_default();
        let name = given.replace("::", "__");
        if name != given {
            self.changes.insert(if named.is_some() { RENAMED } else { DELIMITER });
            if named.is_none() {
                return Ok(false);
            }
            element.set("name", Some(&name));
        }
        let is_free = name != "world" && one(Format::Sdf, "element", name.trim()).is_ok();
        // A camera needs no name.
        match named {
            Some(named) if !is_free && !refers && *named != "camera" => Err((named, NAMELESS)),
            _ => Ok(true),
        }
    }

    fn pose(&mut self, pose: &mut Element) -> Result<bool, Fault> {
        if let Some(frame) = pose.attribute("frame") {
            if !frame.trim().is_empty() {
                self.changes.insert(FRAME);
            }
            pose.set("frame", None);
        }
        let words = pose.own_text().split_whitespace();
        let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
        let count = numbers.map_or(1, |numbers| numbers.len());
        let expected = if pose.attribute("rotation_format") == Some("quat_xyzw") { 7 } else { 6 };
        if [0, expected].contains(&count) { Ok(true) } else { Err(("pose", POSE)) }
    }
}
