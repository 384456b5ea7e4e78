use std::collections::HashMap;

use super::prelude::*;
use crate::vocabulary::{Names, fits};

declare_lint! {
    /// A link or joint has a name that a program refuses.
    ///
    /// - A joint and a link have one name.
    /// - A joint is called `world`, or a link is that is not the root. Of a link that is fixed to one that moves, MuJoCo takes
    ///   it for the world: it stands still, with all that hangs on it.
    /// - A name begins with a slash: tf2 refuses it as the name of a frame.
    /// - A name has `::`, or `__` at both ends: they are reserved in SDFormat.
    /// - A name is empty.
    ///
    /// Choose another name, and change it wherever it is used: SRDF, controllers, launch files.
    LNT015 "name-refused", Warning, Format, since "1.1.0" => name_refused;

    /// A `<gazebo reference>` names neither a link nor a joint.
    ///
    /// Gazebo leaves out its friction, sensors and plugins without a word.
    ///
    /// Write the name of a link or joint.
    LNT044 "gazebo-reference-unknown", Warning, WrongMotion, since "1.1.0" => gazebo_reference_unknown;

    /// A `<ros2_control>` names a joint that the robot does not have.
    ///
    /// From Jazzy on, the controller manager says `Joint 'X' not found in URDF`, and no controller starts. That of Humble
    /// gives the joint to controllers, and nobody knows where it is.
    ///
    /// Write the name of a joint, or remove this one.
    LNT043 "ros2-control-unknown-joint", Error, WrongMotion, since "1.1.0" => ros2_control_unknown_joint;

    /// A `<transmission>` names a joint that the robot does not have.
    ///
    /// ros_control says `Could not find joint`, and the controller does not start.
    ///
    /// Write the name of a joint, or remove the transmission.
    LNT042 "transmission-unknown-joint", Error, WrongMotion, since "1.1.0" => transmission_unknown_joint;

    /// A visual names a material that is not defined.
    ///
    /// Programs refuse the robot, or draw the link in a colour of their own. ROS reads links in the order of the file, so a
    /// definition in a later link does not count.
    ///
    /// Define the material directly in `<robot>`, or write its colour here.
    LNT041 "material-not-defined", Warning, Appearance, since "1.1.0" => material_not_defined;

    /// An element or attribute of URDF is in a place where no program looks.
    ///
    /// Programs ignore it without a word: a `<mass>` directly in `<link>` is 0 kg for Pinocchio, 1 kg for PyBullet, and
    /// for MuJoCo what the volume gives.
    ///
    /// Move it to the element that it belongs to. An `<origin>` of zeros, or `rpy="0 0 0"`, changes nothing anywhere, and is
    /// left out.
    LNT046 "misplaced", Warning, Format, since "1.1.0" => misplaced;

    /// An element or attribute is misspelt.
    ///
    /// Most programs ignore what they do not know, and have a robot without it, or none.
    ///
    /// What other rules find because of it, such as a missing limit, is told here and not by itself; it is then as severe.
    ///
    /// Write the name that is meant.
    LNT040 "misspelt", Warning, Format, since "1.1.0" => misspelt;

    /// An element or attribute is neither URDF's nor that of an extension that several programs know.
    ///
    /// Programs ignore it, but the one that it is for.
    ///
    /// Nothing needs to be done where that program is known. A prefix says whose it is: `<isaac:dont_collapse>`.
    LNT047 "unknown-element-or-attribute", Info, Format, since "1.1.0", off by default => unknown_element_or_attribute
}

fn name_refused(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let links: BTreeSet<&str> = urdf.names(&urdf.links).collect();
    let world = world(urdf);
    let all = urdf.links.iter().map(|node| (node, false));
    for (node, is_joint) in all.chain(urdf.joints.iter().map(|node| (node, true))) {
        let Some(name) = node.attribute("name") else { continue };
        let is_reserved = name.len() >= 4 && name.starts_with("__") && name.ends_with("__");
        let wrong = if name.is_empty() {
            "the name is empty"
        } else if name.starts_with('/') {
            "tf2 refuses names that begin with a slash"
        } else if name.contains("::") || is_reserved {
            "SDFormat, so Gazebo, keeps `::` and `__NAME__` for itself"
        } else if is_joint && links.contains(name) {
            "a link has the same name"
        } else if is_joint && name == WORLD {
            "SDFormat, so Gazebo, keeps the name `world` for the world"
        } else if !is_joint && name == WORLD && world == World::Moved {
            "`world` is the world itself, and a joint moves this link"
        } else if !is_joint && name == WORLD && world == World::Carried {
            "MuJoCo takes the link for the world itself: it stands still, with all that hangs on it, while the robot moves"
        } else if !is_joint && name == WORLD && world == World::Fixed {
            "`world` is the world itself, and this link is fixed to another one"
        } else {
            continue;
        };
        urdf.at_attribute(*node, "name", format!("{wrong}; choose another name")).report(findings);
    }
    Some(())
}

const WORLD: &str = "world";

/// Where the link `world` is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum World {
    /// Nowhere, or at the root.
    Root,
    /// It is fixed to a link that does not move.
    Fixed,
    /// A joint moves it.
    Moved,
    /// It is fixed to a link that moves.
    Carried,
}

fn world<'a>(urdf: &Subject<'a>) -> World {
    let end = |joint: &Node<'a, 'a>, end: &str| {
        let link = joint.children().find(|node| node.has_tag_name(end));
        link.and_then(|link| link.attribute("link")).unwrap_or_default()
    };
    let mut above: HashMap<&str, Node> = HashMap::new();
    for joint in &urdf.joints {
        above.entry(end(joint, "child")).or_insert(*joint);
    }
    let mut link = WORLD;
    // A circle ends with the joints.
    for step in 0..=urdf.joints.len() {
        let Some(joint) = above.get(link) else {
            return if step == 0 { World::Root } else { World::Fixed };
        };
        if moves(*joint) {
            return if step == 0 { World::Moved } else { World::Carried };
        }
        link = end(joint, "parent");
    }
    World::Root
}

fn moves(joint: Node) -> bool {
    joint.attribute("type") != Some("fixed")
}

fn gazebo_reference_unknown(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let known = Names::new(urdf.names(&urdf.links).chain(urdf.names(&urdf.joints)));
    for node in named(urdf.root, "gazebo") {
        let reference = node.attribute("reference").filter(|name| !name.is_empty());
        let Some(reference) = reference.filter(|name| !known.has(name)) else { continue };
        let hint = known.hint(reference);
        let message = format!(
            "neither a link nor a joint is called `{reference}`{hint}; write a name that is there"
        );
        urdf.at_attribute(node, "reference", message).report(findings);
    }
    Some(())
}

fn ros2_control_unknown_joint(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let joints = named(urdf.root, "ros2_control").flat_map(|control| named(control, "joint"));
    joints.for_each(|joint| urdf.names_a_joint(joint, findings));
    Some(())
}

fn transmission_unknown_joint(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let inside = named(urdf.root, "transmission").flat_map(|node| node.descendants());
    let joints = inside.filter(|node| node.tag_name().name() == "joint");
    joints.for_each(|joint| urdf.names_a_joint(joint, findings));
    Some(())
}

fn material_not_defined(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let global = named(urdf.root, "material");
    let mut defined: BTreeSet<&str> = global.filter_map(|node| node.attribute("name")).collect();
    let mut told = BTreeSet::new();
    for link in &urdf.links {
        let visuals = link.children().filter(|node| node.tag_name().name() == "visual");
        for material in visuals.filter_map(|visual| child(visual, "material")) {
            let Some(name) = material.attribute("name").filter(|name| !name.is_empty()) else {
                continue;
            };
            if child(material, "color").is_some() || child(material, "texture").is_some() {
                defined.insert(name);
            } else if !defined.contains(name) && told.insert(name) {
                let message = format!(
                    "material `{}` is not defined in `<robot>`, nor in a link before this one; define it \
                     in `<robot>`",
                    urdd_format::escape::line(name)
                );
                urdf.at_attribute(material, "name", message).report(findings);
            }
        }
    }
    Some(())
}

fn misplaced(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for one in urdf.unknown() {
        if one.meant.is_some() || one.belongs.is_empty() || is_zero(one.node, one.what) {
            continue;
        }
        let places = format!("`<{}>`", one.belongs.join(">` or `<"));
        let message = match one.what {
            What::Element => format!("programs ignore this element here; it belongs in {places}"),
            What::Attribute(name) => {
                format!("programs ignore the attribute `{name}` here; it belongs to {places}")
            }
        };
        urdf.at_unknown(one, message).report(findings);
    }
    Some(())
}

/// Whether it says only what holds without it: numbers that are all 0.
fn is_zero(node: Node, what: What) -> bool {
    let zeros = |text: &str| {
        let mut words = text.split_ascii_whitespace();
        words.all(|word| word.parse() == Ok(0.0))
    };
    match what {
        What::Element => {
            let is_empty = !node.children().any(|child| child.is_element());
            let mut attributes = node.attributes();
            is_empty && attributes.len() > 0 && attributes.all(|one| zeros(one.value()))
        }
        What::Attribute(name) => node.attribute(name).is_some_and(zeros),
    }
}

fn misspelt(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    // Two attributes of one name are no XML.
    let mut meant_so: HashMap<_, usize> = HashMap::new();
    for one in urdf.unknown().iter().filter(|one| matches!(one.what, What::Attribute(_))) {
        *meant_so.entry((one.node.id(), one.meant)).or_default() += 1;
    }
    for one in urdf.unknown() {
        let Some(meant) = one.meant else { continue };
        let (message, attribute) = match one.what {
            What::Element => (format!("programs ignore this element; write `<{meant}>`"), None),
            What::Attribute(name) => {
                let message = format!("programs ignore the attribute `{name}`; write `{meant}`");
                (message, one.node.attribute_node(name))
            }
        };
        let fix = attribute.filter(|attribute| {
            let has_one_meaning = one.is_only
                && meant_so[&(one.node.id(), Some(meant))] == 1
                && !one.node.has_attribute(meant);
            has_one_meaning && fits(meant, attribute.value())
        });
        let fix = fix.map(|attribute| {
            let range = attribute.range_qname();
            urdf.fix(format!("write `{meant}`"), range, meant.to_owned())
        });
        urdf.at_unknown(one, message).fix(fix).report(findings);
    }
    Some(())
}

fn unknown_element_or_attribute(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let unknown = urdf.unknown().iter();
    for one in unknown.filter(|one| one.meant.is_none() && one.belongs.is_empty()) {
        let what = match one.what {
            What::Element => "this element".to_owned(),
            What::Attribute(name) => format!("the attribute `{name}`"),
        };
        let message =
            format!("URDF does not define {what}; programs that do not know it ignore it");
        urdf.at_unknown(one, message).report(findings);
    }
    Some(())
}
