//! libsdformat, with which Gazebo reads URDF: urdfdom reads the file, what it has is written as SDF, and that is read
//! again. What is wrong in the end is refused only in the links and joints that are left.

mod gazebo;
mod inertia;
mod tree;

use crate::prelude::*;
use crate::urdfdom::{self, Model};
use gazebo::{Extensions, stod};
use inertia::{number, vector};
use tree::{Body, Joint, Release, Tree};

pub const FORTRESS: About = About {
    id: "sdformat",
    name: "Gazebo Fortress",
    family: "Gazebo",
    version: "12.3.0",
    settings: &["gazebo", "fortress"],
    is_asked: true,
    is_for: None,
    names: Names::Exact,
    never: &[NEVER, "mimic"],
    read: |file, effects| read(file, Release::Twelve, effects),
};

pub const HARMONIC: About = About {
    id: "sdformat14",
    name: "Gazebo Harmonic",
    version: "14.9.0",
    settings: &["gazebo", "harmonic"],
    never: &[NEVER],
    read: |file, effects| read(file, Release::Fourteen, effects),
    ..FORTRESS
};

/// Gazebo Jetty, whose `parser_urdf.cc` is that of Harmonic.
pub const JETTY: About = About {
    id: "sdformat16",
    name: "Gazebo Jetty",
    version: "16.1.0",
    settings: &["gazebo", "jetty"],
    ..HARMONIC
};

const NEVER: &str =
    "safety_controller calibration acceleration deceleration jerk texture quat_xyzw";

fn read(file: &File, release: Release, effects: &mut Effects) -> Reading<()> {
    let tree = effects.parsed(file.document.within(tinyxml::OLD_MAX_DEPTH))?;
    if let Some(sdf) = tree.tops().find(|top| top.name() == "sdf") {
        return effects.refuse(sdf, Fault::Other("the file has `<sdf>`, and is read as SDF alone"));
    }
    rewritten(file.bytes, tree, effects)?;
    let model = urdfdom::model(tree, urdfdom::Release::Four, effects)?;
    let extensions = gazebo::read(model.robot, release, effects)?;
    let _ = origin(model.robot, effects);
    never_read(&model, release, effects);
    let mut links = Tree::new(&model, &extensions.kept_joints, release);
    links.build(effects)?;
    gazebo::names(model.robot, &links, &extensions.own, effects);
    for (index, body) in links.bodies.iter().enumerate() {
        match body.is_made {
            true => {
                centre(body, links.without_mass, effects);
                made(body, release, || links.spoiler(index), effects);
            }
            false if links.bodies[body.owner].is_made => shapes(body, release, effects),
            false => {}
        }
    }
    mimics(&links, &extensions.own, effects);
    suspects(&links, &extensions, effects);
    Ok(())
}

/// What goes wrong in `<gazebo>` of something that is kept.
fn suspects(links: &Tree<'_>, extensions: &Extensions<'_>, effects: &mut Effects) {
    let made = || links.bodies.iter().filter(|body| body.is_made);
    let joints: HashSet<&str> = made().filter_map(|body| Some(body.joint.as_ref()?.name)).collect();
    for suspect in &extensions.suspects {
        let link = links.of_name.get(suspect.reference).map(|&index| &links.bodies[index]);
        let owner = link.map(|link| &links.bodies[link.owner]).filter(|owner| owner.is_made);
        let is_read = match suspect.of_collisions {
            true => owner.is_some() && link.is_some_and(|link| link.kept[1] > 0),
            false => {
                owner.is_some()
                    || suspect.reference.is_empty()
                    || joints.contains(suspect.reference)
            }
        };
        if is_read {
            effects.refuse_mendable(suspect.at, suspect.fault.clone());
        }
    }
}

const NOT_WRITABLE: &str = "the number is too large or too small";

/// The pose of the robot, which other programs never read.
fn origin(robot: Node<'_>, effects: &mut Effects) -> Reading<()> {
    let Some(origin) = robot.child("origin") else { return Ok(()) };
    for value in ["xyz", "rpy"].into_iter().filter_map(|name| origin.attribute(name)) {
        let mut numbers = Vec::new();
        for piece in pieces(&value.value) {
            let is_number = crate::number::strtod(piece).is_some();
            match stod(piece) {
                Some(number) => numbers.push(number),
                None if is_number => {
                    return effects.crash(value, Fault::range(value, NOT_WRITABLE));
                }
                None => break,
            }
        }
        if numbers.len() == 3 && !numbers.iter().all(|number| number.is_finite()) {
            return effects.refuse(value, Fault::not_a_number(value));
        }
    }
    Ok(())
}

/// What is read by urdfdom, and never written as SDF.
fn never_read(model: &Model<'_>, release: Release, effects: &mut Effects) {
    for (name, joint) in &model.joints {
        let has_mimic = release == Release::Fourteen && joint.kind != "fixed";
        let part = Part::of("joint", name);
        if !has_mimic {
            effects.unread_elements(joint.node, "mimic", &part);
        }
        effects.unread_elements(joint.node, "safety_controller calibration", &part);
    }
    let texture = |material: Node<'_>, part: Part, effects: &mut Effects| {
        if let Some(texture) = material.child("texture") {
            effects.unread(texture, part, "texture");
        }
    };
    for material in model.robot.named("material") {
        let name = material.value("name").unwrap_or_default();
        texture(material, Part::of("material", name), effects);
    }
    for (name, link) in &model.links {
        for (visual, part) in Part::of("link", name).shapes(link.node, "visual") {
            let material = part.inside("material");
            visual.named("material").for_each(|one| texture(one, material.clone(), effects));
        }
    }
}

/// A link that is kept, and its joint. `spoiler` is the link that has to be mended if it has an inertia of no body.
fn made<'t>(
    body: &Body<'t>,
    release: Release,
    spoiler: impl FnOnce() -> Node<'t>,
    effects: &mut Effects,
) {
    if let Some(joint) = &body.joint {
        made_joint(joint, effects);
    }
    shapes(body, release, effects);
    if body.inertia.is_some_and(|inertia| !inertia.is_valid()) {
        let link = spoiler();
        let place = link.child("inertial").unwrap_or(link);
        let inertia = place.child("inertia").unwrap_or(place);
        effects.refuse_mendable(inertia, Fault::Inertia("no body can have this inertia"));
    }
}

/// The centre of mass, which links without mass can take away.
fn centre(body: &Body<'_>, without_mass: Option<usize>, effects: &mut Effects) {
    let center = body.inertia.unwrap_or_default().pose.xyz;
    if let Some(at) = without_mass.filter(|_| !center.into_iter().all(f64::is_finite)) {
        let fault =
            Fault::Inertia("fixed joints join links of mass 0, which have no centre of mass");
        effects.refuse_mendable(at, fault);
    }
}

fn made_joint(joint: &Joint<'_>, effects: &mut Effects) {
    let node = joint.node;
    let part = Part::of("joint", joint.name).inside("limit");
    writable(node.child("origin"), &["xyz"], effects);
    writable(node.child("dynamics"), &["damping", "friction"], effects);
    let ends: &[&str] = if joint.kind == "continuous" { &[] } else { &["lower", "upper"] };
    if let Some(limit) = node.child("limit") {
        writable(Some(limit), ends, effects);
        writable(Some(limit), &["effort", "velocity"], effects);
        let value = |name| limit.attribute(name).and_then(|one| number(&one.value));
        let is_limited = matches!(joint.kind, "revolute" | "prismatic");
        if is_limited && value("lower").unwrap_or(0.0) > value("upper").unwrap_or(0.0) {
            effects.read_as(limit, &part, CROSSED, "one in the place of the other");
        }
        for one in ["effort", "velocity"].into_iter().filter_map(|name| limit.attribute(name)) {
            if number(&one.value).is_some_and(|number| number < 0.0) {
                effects.read_as(one, &part, Fault::range(one, "must not be negative"), "no limit");
            }
        }
    }
    let Some(axis) = node.child("axis").filter(|_| joint.kind != "fixed") else { return };
    let xyz = axis.attribute("xyz");
    let length = xyz.and_then(|xyz| vector(&xyz.value)).unwrap_or_default();
    // Compared with 1e-6 as a number of 32 bits.
    if length.into_iter().map(|part| part * part).sum::<f64>().sqrt() <= f64::from(1e-6_f32) {
        match xyz {
            None => effects.refuse_mendable(axis, Fault::Missing("xyz")),
            Some(xyz) => {
                effects.refuse_mendable(xyz, Fault::range(xyz, "an axis has no length 0"));
            }
        }
    }
}

/// Mimics, from 14 on. Each follows a joint that is kept, or one of SDF with an axis.
fn mimics(links: &Tree<'_>, own: &[Node<'_>], effects: &mut Effects) {
    let release = links.release;
    if release == Release::Twelve {
        return;
    }
    let made = links.bodies.iter().filter(|body| body.is_made);
    let joints = made.filter_map(|body| body.joint.as_ref()).filter(|joint| !joint.has_no_type());
    let own = own.iter().filter(|one| one.name() == "joint" && one.child("axis").is_some());
    let own = own.filter_map(|one| one.value("name"));
    let leaders: HashSet<&str> =
        joints.clone().map(|joint| joint.name).chain(own).map(|name| release.read(name)).collect();
    for joint in joints.filter(|joint| joint.kind != "fixed") {
        let mimic = joint.node.child("mimic");
        let Some(leader) = mimic.and_then(|mimic| mimic.attribute("joint")) else { continue };
        let name = release.read(&leader.value);
        let fault = if name.is_empty() {
            Fault::Empty("joint")
        } else if name == release.read(joint.name) {
            Fault::Other("a joint mimics itself")
        } else if leaders.contains(name) {
            writable(mimic, &["multiplier", "offset"], effects);
            continue;
        } else if links
            .bodies
            .iter()
            .any(|body| body.joint.as_ref().is_some_and(|of| release.read(of.name) == name))
        {
            FOLLOWS_NONE
        } else {
            Fault::unknown("joint", name)
        };
        effects.refuse_mendable(leader, fault);
    }
}

/// The numbers and files of a link that is kept or merged into such a link.
fn shapes(body: &Body<'_>, release: Release, effects: &mut Effects) {
    if let Some(inertial) = body.node.child("inertial").filter(|_| body.is_made) {
        writable(inertial.child("origin"), &["xyz"], effects);
        writable(inertial.child("mass"), &["value"], effects);
        writable(inertial.child("inertia"), &MOMENTS, effects);
    }
    for (kind, count) in ["visual", "collision"].into_iter().zip(body.kept) {
        for shape in body.node.named(kind).take(count) {
            if let Some(name) = shape.attribute("name").filter(|name| release.keeps(&name.value)) {
                effects.refuse_mendable(name, gazebo::reserved(kind, &name.value));
            }
            writable(shape.child("origin"), &["xyz"], effects);
            let form = shape.child("geometry").and_then(|geometry| geometry.children().next());
            if form.is_some_and(|form| matches!(form.name(), "sphere" | "cylinder")) {
                writable(form, &["radius", "length"], effects);
            }
            let mesh = form.filter(|form| form.name() == "mesh");
            if let Some(name) = mesh.and_then(|mesh| mesh.attribute("filename"))
                && release.read(&name.value).is_empty()
            {
                effects.refuse_mendable(name, Fault::Empty("filename"));
            }
        }
    }
}

/// Numbers are written with 16 digits and read with `stod`, which refuses the largest and the smallest.
fn writable(node: Option<Node<'_>>, names: &[&str], effects: &mut Effects) {
    /// From here on, 16 digits are above what is a number.
    const MAX: f64 = 1.797_693_134_862_315_5e308;
    let fits = |number: f64| number == 0.0 || number.is_normal() && number.abs() < MAX;
    let attributes = names.iter().filter_map(|name| node?.attribute(name));
    for value in attributes {
        let mut numbers = pieces(&value.value).filter_map(number);
        if !numbers.all(fits) {
            effects.refuse_mendable(value, Fault::range(value, NOT_WRITABLE));
        }
    }
}

const NOT_UTF8: Fault = Fault::Xml("the file is not UTF-8, which it says or has by default");

/// What TinyXML 2.6.2, in urdfdom 3, refuses of a file that tinyxml2 has read and written again.
fn rewritten(bytes: &[u8], tree: &crate::tree::Tree<'_>, effects: &mut Effects) -> Reading<()> {
    let robot = tree.tops().find(|top| top.name() == "robot").map_or(0, At::at);
    if let Some(text) = tree.stray.filter(|text| *text < robot) {
        return effects.refuse(text, Fault::Xml("text stands before the root"));
    }
    let mut outside_quotes = declaration(bytes)
        .into_iter()
        .flat_map(|inside| inside.split(|&byte| byte == b'"').step_by(2));
    if outside_quotes.any(|piece| piece.contains(&b'>')) {
        return effects.refuse(0, Fault::Xml("the declaration has `>` inside"));
    }
    let is_checked = is_utf8(bytes) && std::str::from_utf8(bytes).is_err();
    for element in &tree.elements {
        let begins_well = |name: &str| !name.starts_with(':');
        // One that is empty is passed over.
        let is_filled = !element.children.is_empty() || element.text.is_some();
        if is_filled && !begins_well(&element.name) {
            let fault = Fault::Xml("the name of an element begins with `:`");
            return effects.refuse(element.tag.start, fault);
        }
        for attribute in &element.attributes {
            if !begins_well(&attribute.name) {
                let fault = Fault::Xml("the name of an attribute begins with `:`");
                return effects.refuse(attribute, fault);
            }
            if is_checked && swallows(value(bytes, attribute)) {
                return effects.refuse(attribute, NOT_UTF8);
            }
        }
        let behind = bytes.get(element.tag.end..).filter(|_| is_checked).unwrap_or_default();
        let text = behind.split(|&byte| byte == b'<').next().unwrap_or_default();
        if swallows(text) {
            return effects.refuse(element.tag.end, NOT_UTF8);
        }
    }
    Ok(())
}

/// What is in the declaration at the beginning of a file.
fn declaration(bytes: &[u8]) -> Option<&[u8]> {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let inside = text.strip_prefix(b"<?xml")?;
    inside.get(..inside.windows(2).position(|two| two == b"?>")?)
}

/// Whether characters are of more than one byte, as they are if there is a declaration that names no other encoding.
fn is_utf8(bytes: &[u8]) -> bool {
    let has_mark = bytes.starts_with(b"\xef\xbb\xbf");
    let Some(declaration) = declaration(bytes) else { return has_mark };
    let declaration = String::from_utf8_lossy(declaration).to_ascii_lowercase();
    let encoding = declaration.split_once("encoding").map_or("", |(_, rest)| rest);
    let name = encoding.split(['"', '\'']).nth(1).unwrap_or_default();
    has_mark || name.is_empty() || name.starts_with("utf-8") || name.starts_with("utf8")
}

fn value<'a>(bytes: &'a [u8], attribute: &Attribute<'_>) -> &'a [u8] {
    let written = bytes.get(attribute.range.clone()).unwrap_or_default();
    let start = written.iter().position(|byte| matches!(byte, b'"' | b'\''));
    let inside = start.and_then(|start| written.get(start + 1..written.len() - 1));
    inside.unwrap_or_default()
}

/// Whether the last character takes what follows with it.
fn swallows(text: &[u8]) -> bool {
    let mut at = 0;
    while let Some(byte) = text.get(at) {
        at += match byte {
            0xc2..=0xdf => 2,
            0xe0..=0xef => 3,
            0xf0..=0xf4 => 4,
            _ => 1,
        };
    }
    at > text.len()
}
