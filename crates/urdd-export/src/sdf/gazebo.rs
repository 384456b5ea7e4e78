//! What `<gazebo>` elements say, where SDF has it: as libsdformat's own converter from URDF places it (`parser_urdf.cc`).
//! Fixed joints stay fixed joints here, as `preserveFixedJoint` asks for; without it, the converter joins their links.
//!
//! Other elements go into an SDF as they are, but for what makes libsdformat or Drake refuse the whole file. What is inside a
//! `<plugin>` is the plugin's own: nobody reads it.

use std::collections::{BTreeSet, HashMap, HashSet};

use crate::names::one;
use crate::urdf_elements::document;
use crate::{Format, Note, Subject, Taken};
use urdd_xml::element::wrapped;
use urdd_xml::number::number;
use urdd_xml::writer::Element;

const UNCHECKED: &str = "what `<gazebo>` elements say is where SDF has it; plugins, sensors and other elements in them are as the source has them, and not checked: Drake refuses those that SDF does not define";

/// The elements of a model, a link or a joint in SDF 1.9 to 1.11. Left out are those that may stand there once, where ours
/// are (`<pose>`, `<inertial>`, `<axis>`), and `<include>`, which names another file. Drake refuses what is not defined,
/// and no parser reads it.
const ELEMENTS: &str = "allow_auto_disable audio_sink audio_source auto_inertia battery collision enable_wind frame \
    gearbox_ratio gearbox_reference_body gravity gripper joint kinematic light link model \
    must_be_base_link particle_emitter physics plugin projector screw_thread_pitch self_collide sensor \
    static thread_pitch velocity_decay visual";

/// Drake refuses it, and nothing reads it.
const OLD_NOISE: &str = "it is right in `<imu>`, where SDF had it up to 1.4";

/// What a word is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Model,
    Link,
    Visual,
    Collision,
    Joint,
}

/// How a word's value is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Value {
    Number,
    Flag,
    Opposite,
    Text,
    Elements,
}

use Place::{Collision, Joint, Link, Model, Visual};
use Value::{Elements, Flag, Number, Opposite, Text};

/// A word, what it is about, how its value is written, and the elements that contain it.
type Word = (&'static str, Place, Value, &'static [&'static str]);

/// The words that the converter knows. Any other element of [`ELEMENTS`] goes into the link, joint or model.
const WORDS: [Word; 26] = [
    ("static", Model, Flag, &["static"]),
    ("turnGravityOff", Link, Opposite, &["gravity"]),
    ("selfCollide", Link, Flag, &["self_collide"]),
    ("dampingFactor", Link, Number, &["velocity_decay/linear", "velocity_decay/angular"]),
    ("visual", Visual, Elements, &[]),
    ("material", Visual, Text, &["material/script/name"]),
    ("collision", Collision, Elements, &[]),
    ("mu1", Collision, Number, &["surface/friction/ode/mu"]),
    ("mu2", Collision, Number, &["surface/friction/ode/mu2"]),
    ("fdir1", Collision, Text, &["surface/friction/ode/fdir1"]),
    ("kp", Collision, Number, &["surface/contact/ode/kp"]),
    ("kd", Collision, Number, &["surface/contact/ode/kd"]),
    ("maxVel", Collision, Number, &["surface/contact/ode/max_vel"]),
    ("minDepth", Collision, Number, &["surface/contact/ode/min_depth"]),
    ("maxContacts", Collision, Number, &["max_contacts"]),
    ("laserRetro", Collision, Number, &["laser_retro"]),
    ("stopCfm", Joint, Number, &["physics/ode/limit/cfm"]),
    ("stopErp", Joint, Number, &["physics/ode/limit/erp"]),
    ("fudgeFactor", Joint, Number, &["physics/ode/fudge_factor"]),
    ("provideFeedback", Joint, Flag, &["physics/provide_feedback"]),
    ("cfmDamping", Joint, Flag, IMPLICIT),
    ("implicitSpringDamper", Joint, Flag, IMPLICIT),
    ("springReference", Joint, Number, &["axis/dynamics/spring_reference"]),
    ("springStiffness", Joint, Number, &["axis/dynamics/spring_stiffness"]),
    ("preserveFixedJoint", Joint, Flag, &[]),
    ("disableFixedJointLumping", Joint, Flag, &[]),
];

const IMPLICIT: &[&str] = &["physics/ode/implicit_spring_damper", "physics/ode/cfm_damping"];

const TAKEN: &str = "another element has the name of one in it";
const JOINED: &str = "it is about a link that is joined with another";

/// What is said, by the name of a link or a joint; by an empty name, of the model.
pub(super) struct Gazebo(HashMap<String, Vec<Element>>);

impl Gazebo {
    pub fn new(subject: &Subject, notes: &mut Vec<Note>) -> Self {
        let joints = subject.view.joints.iter().map(|joint| &joint.name);
        let names: HashSet<&String> = subject.links.iter().chain(joints).collect();
        let mut said: HashMap<String, Vec<Element>> = HashMap::new();
        let mut mended = Mended::default();
        let mut unreadable = 0;
        for text in &subject.urdf.unknown_elements {
            // Prefixes that only the source declares do not matter: what has them is left out.
            let whole = wrapped(text);
            let Some(document) = document(&whole) else {
                unreadable += usize::from(text.trim_start().starts_with("<gazebo"));
                continue;
            };
            let Some(root) = document.root_element().first_element_child() else { continue };
            if !root.has_tag_name("gazebo") {
                continue;
            }
            let reference = root.attribute("reference").unwrap_or_default().to_owned();
            if !reference.is_empty() && !names.contains(&reference) {
                mended.faults.insert(("gazebo", "it refers to what is neither a link nor a joint"));
                continue;
            }
            let is_of_part = !reference.is_empty();
            let said = said.entry(reference).or_default();
            for mut element in root.children().filter(|node| node.is_element()).map(Element::of) {
                if element.child_mut("imu").is_some_and(|imu| imu.remove("noise")) {
                    mended.faults.insert(("noise", OLD_NOISE));
                }
                let known = word(&element).map(|word| word.2);
                let fault = match known {
                    Some(Number) if !own(&element).parse().is_ok_and(f64::is_finite) => {
                        Some("a number in it is not one")
                    }
                    None if element.has_prefix() => Some("it has a prefix of its file"),
                    None if ELEMENTS.split(' ').all(|known| known != element.name()) => Some(
                        "an element in it is not defined by SDF for a model, a link or a joint, or cannot be added to ours",
                    ),
                    _ => None,
                };
                match fault {
                    Some(fault) => {
                        mended.faults.insert(("gazebo", fault));
                    }
                    None if is_of_part && element.name() == "plugin" => {
                        mended.move_plugin(&mut element);
                    }
                    // A visual and a collision of a link have no name here.
                    None if known.is_some() => {
                        mended.mend_inside(&mut element);
                        said.push(element);
                    }
                    None => said.extend(mended.mend(&mut element).then_some(element)),
                }
            }
            // Words overwrite what such elements have.
            said.sort_by_key(|said| word(said).is_none_or(|word| word.2 != Elements));
        }
        follow(subject, &mut said, &mut mended.faults);
        let faults = mended.faults.into_iter();
        notes.extend(faults.map(|(element, reason)| Note::Element { element, reason }));
        notes.extend(mended.changes.into_iter().map(Note::Robot));
        if !mended.plugins.is_empty() {
            said.entry(String::new()).or_default().extend(mended.plugins);
        }
        if unreadable > 0 {
            notes.push(Note::Elements(unreadable));
        }
        if said.values().flatten().any(|said| word(said).is_none()) {
            notes.push(Note::Robot(UNCHECKED));
        }
        Gazebo(said)
    }

    /// Adds what is said of a link, a joint or the model to an element. `taken` has the names of the elements in it.
    pub fn add(
        &self,
        name: &str,
        place: Place,
        into: &mut Element,
        taken: &mut Taken,
        notes: &mut Vec<Note>,
    ) {
        let has_axis = into.elements().any(|child| child.name() == "axis");
        for said in self.0.get(name).into_iter().flatten() {
            let Some((_, of, value, paths)) = word(said) else {
                // Plugins alone may share a name.
                let name = said.attribute("name").filter(|_| said.name() != "plugin");
                if ![Visual, Collision].contains(&place) {
                    if name.is_none_or(|name| taken.insert(name)) {
                        into.push(said.clone())
                    } else {
                        notes.push(Note::Element { element: "gazebo", reason: TAKEN })
                    }
                }
                continue;
            };
            if *of != place || (paths.iter().any(|path| path.starts_with("axis")) && !has_axis) {
                continue;
            }
            let own = own(said);
            let is_true = ["true", "yes", "1"].contains(&own.to_lowercase().as_str());
            let text = match value {
                Flag => is_true.to_string(),
                Opposite => (!is_true).to_string(),
                Number => number(own.parse().unwrap_or_default()),
                Text => own.to_owned(),
                Elements => {
                    for child in said.elements().filter(|child| !child.has_prefix()) {
                        if ["surface", "material"].contains(&child.name()) {
                            into.remove(child.name());
                        }
                        into.push(child.clone());
                    }
                    continue;
                }
            };
            for path in *paths {
                into.say(path, &text);
            }
            if said.name() == "material" {
                into.say("material/script/uri", SCRIPTS);
            }
        }
    }
}

/// What SDF places in a link by a pose.
const PLACED: [&str; 5] = ["audio_source", "light", "particle_emitter", "projector", "sensor"];

/// What is said of a link whose frame is elsewhere goes to the link that has its content, with poses in that frame. What is
/// said of collisions is found by the name of the link.
fn follow(
    subject: &Subject,
    said: &mut HashMap<String, Vec<Element>>,
    faults: &mut BTreeSet<(&'static str, &'static str)>,
) {
    for link in 0..subject.layout.content.len() {
        let (body, frame) = (subject.layout.body(link), subject.layout.frame(link));
        if body == frame {
            continue;
        }
        let [own, body, frame] = [link, body, frame].map(|link| subject.links[link].as_str());
        for mut element in said.remove(own).unwrap_or_default() {
            let place = word(&element).map(|word| word.1);
            if PLACED.contains(&element.name()) {
                if element.child_mut("pose").is_none() {
                    element.say("pose", "");
                }
                let pose = element.child_mut("pose");
                if let Some(pose) = pose.filter(|pose| pose.attribute("relative_to").is_none()) {
                    pose.set("relative_to", Some(frame));
                }
            }
            if own != body && place == Some(Collision) {
                said.entry(own.to_owned()).or_default().push(element);
            } else if own != body && place.is_some() {
                faults.insert(("gazebo", JOINED));
            } else {
                said.entry(body.to_owned()).or_default().push(element);
            }
        }
    }
}

/// Where Gazebo has the materials that it names.
const SCRIPTS: &str = "file://media/materials/scripts/gazebo.material";

fn word(said: &Element) -> Option<&'static Word> {
    WORDS.iter().find(|word| word.0 == said.name())
}

fn own(said: &Element) -> &str {
    said.attribute("value").map_or(said.own_text(), str::trim)
}

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

    fn mend_inside(&mut self, element: &mut Element) {
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
    fn move_plugin(&mut self, plugin: &mut Element) {
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
