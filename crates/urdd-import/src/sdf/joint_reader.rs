//! Reads joints.

use nalgebra::Vector3;

use super::reader::{SdfReader, keep};
use super::scene::{Axis, Joint, Mimic, Node, NodeKind, SdfJointKind, WORLD};
use super::tag::{Tag, is_true};
use crate::fault::SdfFault;
use crate::features;
use crate::place::{Fallible, at};

/// From this number on, a limit is none.
const NO_LIMIT: f64 = 1e16;
/// The last minor version in which axes are along the model's frame, unless they say otherwise. libsdformat looks at
/// models that are not inside others.
const AXES_OF_MODEL: u32 = 4;
/// The last one in which `use_parent_model_frame` says so.
const AXES_BY_FLAG: u32 = 6;
const KNOWN: &[&str] = &[
    "parent",
    "child",
    "pose",
    "thread_pitch",
    "screw_thread_pitch",
    "gearbox_ratio",
    "gearbox_reference_body",
];

pub fn joint(reader: &mut SdfReader, tag: Tag, scope: usize) -> Fallible<()> {
    let name = tag.own_name()?;
    let (node, joint) = read(reader, tag, scope)?;
    if !reader.scene.add(scope, &name, node) {
        return Err(at(tag.place(), SdfFault::Twice { kind: "joint", name }));
    }
    reader.scene.joints.push(joint);
    Ok(())
}

/// What a joint says, and the node that is to be the next.
pub fn read(reader: &mut SdfReader, tag: Tag, scope: usize) -> Fallible<(Node, Joint)> {
    let name = tag.own_name()?;
    let whole = reader.whole_name(tag, scope, &name)?;
    let kind = kind(tag, &name)?;
    let [parent, child] = [end(tag, "parent")?, end(tag, "child")?];
    if child == WORLD {
        return Err(at(tag.place(), SdfFault::WorldChild(name)));
    }
    let node_kind = NodeKind::Joint(reader.scene.joints.len());
    let node = Node::of(tag, whole.clone(), node_kind, scope)?;
    let node = Node { attached_to: Some(child), ..node };
    let wanted: &[&str] = match kind {
        SdfJointKind::Fixed | SdfJointKind::Ball => &[],
        SdfJointKind::Gearbox(_) if tag.child("axis2").is_none() => &["axis"],
        SdfJointKind::Two | SdfJointKind::Gearbox(_) => &["axis", "axis2"],
        _ => &["axis"],
    };
    let axes = wanted.iter().map(|wanted| {
        let axis_tag = tag.child(wanted);
        if let Some(axis) = axis_tag {
            said_of_axis(reader, axis, &whole);
        }
        axis(tag, axis_tag, &name)
    });
    let axes = axes.collect::<Fallible<Vec<Axis>>>()?;
    for child in tag.children() {
        match child.name() {
            "sensor" => keep(reader, child, Some((&whole, reader.scene.nodes.len())))?,
            "physics" => reader.tally.count(features::SETTINGS),
            name if KNOWN.contains(&name) || wanted.contains(&name) => {}
            name => reader.tally.unread(format!("`<{name}>` of `<joint>`")),
        }
    }
    let reference = tag.words("gearbox_reference_body");
    Ok((node, Joint { node: reader.scene.nodes.len(), kind, parent, axes, reference }))
}

fn kind(tag: Tag, name: &str) -> Fallible<SdfJointKind> {
    let word = tag.attribute("type").unwrap_or_default().trim().to_lowercase();
    Ok(match word.as_str() {
        "fixed" => SdfJointKind::Fixed,
        "revolute" => SdfJointKind::Hinge,
        "continuous" => SdfJointKind::Continuous,
        "prismatic" => SdfJointKind::Slide,
        "ball" => SdfJointKind::Ball,
        "revolute2" | "universal" => SdfJointKind::Two,
        "gearbox" => SdfJointKind::Gearbox(tag.number("gearbox_ratio")?.unwrap_or(1.0)),
        "screw" => SdfJointKind::Screw(match tag.number("screw_thread_pitch")? {
            Some(pitch) => pitch,
            // Radians for a metre, of a left-handed thread.
            None => match tag.number("thread_pitch")? {
                Some(turns) if turns != 0.0 => -std::f64::consts::TAU / turns,
                Some(_) => 0.0,
                None => 1.0,
            },
        }),
        _ => {
            let (joint, kind) = (name.to_owned(), word);
            return Err(at(tag.place(), SdfFault::JointType { joint, kind }));
        }
    })
}

/// The name of an end of a joint.
///
/// # Errors
/// If there is none.
pub fn end(tag: Tag, child: &'static str) -> Fallible<String> {
    // Files of SDF 1.2 have the name in an element of its own.
    let inside = tag.child(child).and_then(|end| end.words("link_name"));
    match inside.or_else(|| tag.words(child)) {
        Some(name) => Ok(name),
        None => tag.lacks(child),
    }
}

/// Counts what an axis says that is not read.
fn said_of_axis(reader: &mut SdfReader, axis: Tag, joint: &str) {
    let tally = &mut reader.tally;
    axis.unread(&["xyz", "dynamics", "limit", "mimic", "use_parent_model_frame"], tally);
    if let Some(dynamics) = axis.child("dynamics") {
        let spring = dynamics.number("spring_stiffness");
        if spring.ok().flatten().is_some_and(|stiffness| stiffness != 0.0) {
            let text = format!("the spring of joint `{joint}` is lost");
            tally.say(features::SPRINGS, axis.place(), text);
        }
    }
    for stop in ["stiffness", "dissipation"] {
        if axis.descendant(&["limit", stop]).is_some() {
            tally.count(features::SETTINGS);
        }
    }
}

/// Whether an axis of an old file is along the model's frame.
fn is_of_model(joint: Tag, axis: Tag) -> bool {
    let model = joint.node.parent().and_then(|model| model.parent());
    let is_nested = model.is_some_and(|around| around.has_tag_name("model"));
    match axis.child("use_parent_model_frame") {
        Some(flag) => axis.version <= AXES_BY_FLAG && is_true(&flag.text()),
        None => axis.version <= AXES_OF_MODEL && !is_nested,
    }
}

fn axis(joint: Tag, tag: Option<Tag>, name: &str) -> Fallible<Axis> {
    let place = tag.unwrap_or(joint).place();
    let mut axis = Axis {
        xyz: Vector3::z(),
        expressed_in: None,
        range: [f64::NEG_INFINITY, f64::INFINITY],
        effort: None,
        velocity: None,
        damping: 0.0,
        friction: 0.0,
        mimic: None,
        place,
    };
    let Some(tag) = tag else { return Ok(axis) };
    if let Some(xyz) = tag.vector("xyz")? {
        let Some(direction) = xyz.try_normalize(1e-9) else {
            return Err(at(tag.place(), SdfFault::ZeroAxis(name.to_owned())));
        };
        axis.xyz = direction;
    }
    let named = tag.child("xyz").and_then(|xyz| xyz.attribute("expressed_in"));
    let named = if is_of_model(joint, tag) { Some("__model__") } else { named };
    axis.expressed_in = named.map(str::to_owned);
    if let Some(limit) = tag.child("limit") {
        for (side, name) in axis.range.iter_mut().zip(["lower", "upper"]) {
            if let Some(value) = limit.any_number(name)? {
                *side = if value.abs() < NO_LIMIT { value } else { value.signum() * f64::INFINITY };
            }
        }
        let bound = |name| -> Fallible<Option<f64>> {
            Ok(limit.any_number(name)?.filter(|value| (0.0..NO_LIMIT).contains(value)))
        };
        (axis.effort, axis.velocity) = (bound("effort")?, bound("velocity")?);
    }
    if let Some(dynamics) = tag.child("dynamics") {
        axis.damping = dynamics.number("damping")?.unwrap_or_default();
        axis.friction = dynamics.number("friction")?.unwrap_or_default();
    }
    if let Some(mimic) = tag.child("mimic") {
        let Some(leader) = mimic.attribute("joint") else {
            return Err(at(mimic.place(), SdfFault::NoName("mimic".to_owned())));
        };
        axis.mimic = Some(Mimic {
            joint: leader.to_owned(),
            is_second: mimic.attribute("axis") == Some("axis2"),
            multiplier: mimic.number("multiplier")?.unwrap_or(1.0),
            offset: mimic.number("offset")?.unwrap_or_default(),
            reference: mimic.number("reference")?.unwrap_or_default(),
            place: mimic.place(),
        });
    }
    Ok(axis)
}

/// Reads the joints between the model that was read and the world. The others are lost.
pub fn world_joints(reader: &mut SdfReader, world: Tag, model: &str) -> Fallible<()> {
    for tag in world.children().filter(|child| child.name() == "joint") {
        let inside = |name: &str| match name.strip_prefix(model)? {
            "" => Some("__model__".to_owned()),
            rest => rest.strip_prefix("::").map(str::to_owned),
        };
        let parent = end(tag, "parent")?;
        let parent = if parent == WORLD { Some(parent) } else { inside(&parent) };
        let axes = ["axis", "axis2"].map(|axis| tag.descendant(&[axis, "xyz"]));
        let axes = axes.map(|xyz| xyz.and_then(|xyz| xyz.attribute("expressed_in")));
        let (_, relative_to) = tag.pose()?;
        let frames = axes.into_iter().chain([relative_to.as_deref()]).flatten();
        let is_known =
            frames.filter(|name| *name != "__model__").all(|name| inside(name).is_some());
        let Some((parent, child)) = parent.zip(inside(&end(tag, "child")?)).filter(|_| is_known)
        else {
            reader.tally.unread("`<joint>` of `<world>`");
            let text = "a joint of the world to what is not of the robot is lost";
            reader.tally.remark(tag.place(), text);
            continue;
        };
        let (mut node, mut joint) = read(reader, tag, 0)?;
        node.attached_to = Some(child);
        node.relative_to = node.relative_to.as_deref().and_then(inside);
        joint.parent = parent;
        for axis in &mut joint.axes {
            axis.expressed_in = axis.expressed_in.as_deref().map(|name| match inside(name) {
                Some(inside) => inside,
                None => name.to_owned(),
            });
        }
        // Names in the model do not mean it: it is in no table.
        reader.scene.nodes.push(node);
        reader.scene.joints.push(joint);
    }
    Ok(())
}
