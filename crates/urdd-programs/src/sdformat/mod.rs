//! libsdformat 12.3.0, with which Gazebo reads URDF: urdfdom 3 reads the file, what it has is written as SDF, and that is
//! read again. What is wrong in the end is refused only in the links and joints that are left.

mod gazebo;
mod inertia;
mod names;
mod tree;
mod values;
mod xml;

use self::gazebo::{Extensions, stod};
use self::tree::{Body, Joint, Tree};
use self::values::{number, vector};
use crate::about::About;
use crate::effect::{Effects, Reading};
use crate::fault::Fault;
use crate::file::File;
use crate::number::pieces;
use crate::part::Part;
use crate::tinyxml;
use crate::tree::Node;
use crate::unknown::Names;
use crate::urdfdom::{self, Model, Release};

/// Gazebo.
pub(crate) const ABOUT: About = About {
    id: "sdformat",
    name: "Gazebo (libsdformat 12)",
    family: "Gazebo",
    version: "12.3.0",
    settings: &["gazebo"],
    is_asked: true,
    names: Names::Exact,
    never: &[
        "mimic",
        "safety_controller",
        "calibration",
        "acceleration",
        "deceleration",
        "jerk",
        "texture",
        "quat_xyzw",
    ],
    read,
};

pub(crate) fn read(file: &File, effects: &mut Effects) -> Reading<()> {
    let tree = effects.parsed(file.document.within(tinyxml::OLD_MAX_DEPTH))?;
    if let Some(sdf) = tree.tops().find(|top| top.name() == "sdf") {
        return effects.refuse(sdf, Fault::Other("the file has `<sdf>`, and is read as SDF alone"));
    }
    xml::check(file.bytes, tree, effects)?;
    let model = urdfdom::model(tree, Release::Four, effects)?;
    let extensions = gazebo::read(model.robot, effects)?;
    origin(model.robot, effects)?;
    never_read(&model, effects);
    let mut links = Tree::new(&model, &extensions.kept_joints);
    links.build(effects)?;
    names::check(model.robot, &links, &extensions.own, effects)?;
    for body in &links.bodies {
        match body.is_made {
            true => {
                centre(body, links.without_mass, effects)?;
                made(body, effects)?;
            }
            false if links.bodies[body.owner].is_made => shapes(body, effects)?,
            false => {}
        }
    }
    suspects(&links, &extensions, effects)
}

/// What goes wrong in `<gazebo>` of something that is kept.
fn suspects(links: &Tree<'_>, extensions: &Extensions<'_>, effects: &mut Effects) -> Reading<()> {
    let made = || links.bodies.iter().filter(|body| body.is_made);
    let joints: std::collections::HashSet<&str> =
        made().filter_map(|body| Some(body.joint.as_ref()?.name)).collect();
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
            return effects.refuse(suspect.at, suspect.fault.clone());
        }
    }
    Ok(())
}

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
                    let rule = "the number is too large or too small";
                    return effects.crash(value, Fault::range(&value.name, &value.value, rule));
                }
                None => break,
            }
        }
        if numbers.len() == 3 && !numbers.iter().all(|number| number.is_finite()) {
            return effects.refuse(value, Fault::not_a_number(&value.name, &value.value));
        }
    }
    Ok(())
}

/// What is read by urdfdom, and never written as SDF.
fn never_read(model: &Model<'_>, effects: &mut Effects) {
    for (name, joint) in &model.joints {
        for element in ["mimic", "safety_controller", "calibration"] {
            if let Some(node) = joint.node.child(element) {
                let part = Part::of("joint", name).inside(element);
                effects.drop(node, part, Fault::NeverRead(element.into()));
            }
        }
    }
    let texture = |material: Node<'_>, part: Part, effects: &mut Effects| {
        if let Some(texture) = material.child("texture") {
            effects.drop(texture, part, Fault::NeverRead("texture".into()));
        }
    };
    for material in model.robot.named("material") {
        let name = material.value("name").unwrap_or_default();
        texture(material, Part::of("material", name), effects);
    }
    for (name, link) in &model.links {
        for (index, visual) in link.node.named("visual").enumerate() {
            let part = Part::of("link", name).inside(format_args!("visual/{index}/material"));
            visual.named("material").for_each(|one| texture(one, part.clone(), effects));
        }
    }
}

/// A link that is kept, and its joint.
fn made(body: &Body<'_>, effects: &mut Effects) -> Reading<()> {
    if let Some(joint) = &body.joint {
        made_joint(joint, effects)?;
    }
    shapes(body, effects)?;
    if body.inertia.is_some_and(|inertia| !inertia.is_valid()) {
        let place = body.node.child("inertial").unwrap_or(body.node);
        let inertia = place.child("inertia").unwrap_or(place);
        return effects.refuse(inertia, Fault::Inertia("no body can have this inertia"));
    }
    Ok(())
}

/// The centre of mass, which links without mass can take away.
fn centre(body: &Body<'_>, without_mass: Option<usize>, effects: &mut Effects) -> Reading<()> {
    let center = body.inertia.unwrap_or_default().pose.xyz;
    match without_mass {
        Some(at) if !center.into_iter().all(f64::is_finite) => {
            let fault =
                Fault::Inertia("fixed joints join links of mass 0, which have no centre of mass");
            effects.refuse(at, fault)
        }
        _ => Ok(()),
    }
}

fn made_joint(joint: &Joint<'_>, effects: &mut Effects) -> Reading<()> {
    let node = joint.node;
    let part = Part::of("joint", joint.name).inside("limit");
    writable(node.child("origin"), &["xyz"], effects)?;
    writable(node.child("dynamics"), &["damping", "friction"], effects)?;
    let ends: &[&str] = if joint.kind == "continuous" { &[] } else { &["lower", "upper"] };
    if let Some(limit) = node.child("limit") {
        writable(Some(limit), ends, effects)?;
        writable(Some(limit), &["effort", "velocity"], effects)?;
        let value = |name| limit.attribute(name).and_then(|one| number(&one.value));
        let is_limited = matches!(joint.kind, "revolute" | "prismatic");
        if is_limited && value("lower").unwrap_or(0.0) > value("upper").unwrap_or(0.0) {
            let fault = Fault::Limits("`lower` is above `upper`");
            effects.read_as(limit, &part, fault, "one in the place of the other");
        }
        for one in ["effort", "velocity"].into_iter().filter_map(|name| limit.attribute(name)) {
            if number(&one.value).is_some_and(|number| number < 0.0) {
                let fault = Fault::range(&one.name, &one.value, "must not be negative");
                effects.read_as(one, &part, fault, "no limit");
            }
        }
    }
    let Some(axis) = node.child("axis").filter(|_| joint.kind != "fixed") else { return Ok(()) };
    let xyz = axis.attribute("xyz");
    let length = xyz.and_then(|xyz| vector(&xyz.value)).unwrap_or_default();
    // Compared with 1e-6 as a number of 32 bits.
    if length.into_iter().map(|part| part * part).sum::<f64>().sqrt() <= f64::from(1e-6_f32) {
        return match xyz {
            None => effects.refuse(axis, Fault::Missing("xyz")),
            Some(xyz) => {
                let rule = "an axis has no length 0";
                effects.refuse(xyz, Fault::range("xyz", &xyz.value, rule))
            }
        };
    }
    Ok(())
}

/// The numbers and files of a link that is kept or merged into such a link.
fn shapes(body: &Body<'_>, effects: &mut Effects) -> Reading<()> {
    if let Some(inertial) = body.node.child("inertial").filter(|_| body.is_made) {
        writable(inertial.child("origin"), &["xyz"], effects)?;
        writable(inertial.child("mass"), &["value"], effects)?;
        let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
        writable(inertial.child("inertia"), &names, effects)?;
    }
    for (kind, count) in ["visual", "collision"].into_iter().zip(body.kept) {
        for shape in body.node.named(kind).take(count) {
            writable(shape.child("origin"), &["xyz"], effects)?;
            let form = shape.child("geometry").and_then(|geometry| geometry.children().next());
            if form.is_some_and(|form| matches!(form.name(), "sphere" | "cylinder")) {
                writable(form, &["radius", "length"], effects)?;
            }
            let mesh = form.filter(|form| form.name() == "mesh");
            if let Some(name) = mesh.and_then(|mesh| mesh.attribute("filename"))
                && names::trimmed(&name.value).is_empty()
            {
                return effects.refuse(name, Fault::Empty("filename"));
            }
        }
    }
    Ok(())
}

/// Numbers are written with 16 digits and read with `stod`, which refuses the largest and the smallest.
fn writable(node: Option<Node<'_>>, names: &[&str], effects: &mut Effects) -> Reading<()> {
    /// From here on, 16 digits are above what is a number.
    const MAX: f64 = 1.797_693_134_862_315_5e308;
    let fits = |number: f64| number == 0.0 || number.is_normal() && number.abs() < MAX;
    let attributes = names.iter().filter_map(|name| node?.attribute(name));
    for value in attributes {
        let mut numbers = pieces(&value.value).filter_map(number);
        if !numbers.all(fits) {
            let rule = "the number is too large or too small";
            return effects.refuse(value, Fault::range(&value.name, &value.value, rule));
        }
    }
    Ok(())
}
