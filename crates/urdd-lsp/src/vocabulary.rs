//! The elements and attributes that can be written in a URDF: those that `urdd lint` knows, and those in transmissions and
//! in ros2_control, whose content it leaves to other programs.

use urdd_lint::vocabulary::of;

/// An element: where it is, its name, its attributes, and what it contains.
type Word = (&'static str, &'static str, &'static [&'static str], &'static [&'static str]);

/// Elements that other programs read.
const WORDS: &[Word] = &[
    ("robot", "gazebo", &["reference"], &[]),
    ("robot", "transmission", &["name"], &["type", "joint", "actuator"]),
    ("transmission", "joint", &["name"], &["hardwareInterface"]),
    ("transmission", "actuator", &["name"], &["hardwareInterface", "mechanicalReduction"]),
    ("robot", "ros2_control", &["name", "type"], &["hardware", "joint", "sensor", "gpio"]),
    ("ros2_control", "joint", &["name"], &["command_interface", "state_interface", "param"]),
];

/// The attributes of an element in another one.
pub fn attributes(parent: &str, name: &str) -> Vec<&'static str> {
    let attributes = match find(parent, name) {
        Some((_, _, attributes, _)) => attributes,
        None => of(name).map_or(&[][..], |known| known.attributes),
    };
    // A declaration that only xacro needs.
    let xacro = (name == "robot").then_some("xmlns:xacro");
    attributes.iter().copied().chain(xacro).collect()
}

/// What an element in another one contains.
pub fn children(parent: &str, name: &str) -> &'static [&'static str] {
    match find(parent, name) {
        Some((.., children)) => children,
        None => of(name).map_or(&[][..], |known| known.children),
    }
}

fn find(parent: &str, name: &str) -> Option<&'static Word> {
    WORDS.iter().find(|word| (word.0, word.1) == (parent, name))
}
