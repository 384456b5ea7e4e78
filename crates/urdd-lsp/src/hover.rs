//! What is at the cursor: the robot, a link, a joint, a mesh, a value of a document.

use std::fs;

use lsp_types::{Hover, Position};
use nalgebra::Isometry3;
use urdd_document::robot::Joint;
use urdd_format::escape;
use urdd_format::readable::number;
use urdd_format::urdf::JointType;
use urdd_geometry::Mesh;

use crate::document::{FileKind, RobotModel, Snapshot};
use crate::markup::Place;
use crate::reference::{Names, reference};
use crate::text::{code, markdown, sentence};
use crate::urdd_documents;

/// Significant digits of numbers.
const DIGITS: usize = 5;
/// Significant digits of the lengths of a mesh.
const MESH_DIGITS: usize = 4;
/// How many children are named.
const MOST_CHILDREN: usize = 10;
/// Lengths and angles below this are shown as 0: they come from rounding.
const ZERO: f64 = 1e-9;

/// What is at a position. `programs` says what programs do with the robot.
pub fn hover(
    snapshot: &Snapshot,
    at: Position,
    programs: impl FnOnce() -> Vec<String>,
) -> Option<Hover> {
    if let FileKind::Urdd { schema, is_yaml } = snapshot.kind {
        return urdd_documents::hover(snapshot, schema?, is_yaml, at);
    }
    let offset = snapshot.text.offset(at);
    let root = snapshot.markup().place(snapshot.text.as_str(), offset);
    if let (FileKind::Urdf, Place::TagName { element: 0 }) = (snapshot.kind, root) {
        return in_programs(snapshot, &programs());
    }
    let found = reference(snapshot, offset)?;
    let range = Some(snapshot.text.range(found.range.clone()));
    let robot = snapshot.robot();
    let text = match found.to {
        Names::Links => link(robot.as_deref()?, &found.name)?,
        Names::Joints | Names::Both => match robot.as_deref() {
            Some(robot) => joint(robot, &found.name)?,
            None => joint_as_written(snapshot, &found.name)?,
        },
        Names::Meshes => mesh(robot.as_deref(), snapshot, &found.name, found.element),
        Names::Materials => return None,
    };
    Some(markdown(text, range))
}

/// What programs do with the robot, at the name of its element.
fn in_programs(snapshot: &Snapshot, lines: &[String]) -> Option<Hover> {
    let mut text = lines.first().map(|_| "**In programs**\n".to_owned())?;
    for line in lines {
        text += &format!("\n- {}", sentence(line));
    }
    let root = snapshot.markup().elements.first()?;
    Some(markdown(text, Some(snapshot.text.range(root.name.clone()))))
}

fn link(model: &RobotModel, name: &str) -> Option<String> {
    let index = model.robot.link(name)?;
    let link = &model.robot.links[index];
    let mut lines = vec![format!("**link {}**\n", code(name))];
    let mass = link.inertial.as_ref().and_then(|inertial| inertial.mass);
    lines.push(match mass {
        Some(mass) => format!("- mass: {} kg", number(mass, DIGITS)),
        None => "- mass: none".to_owned(),
    });
    if let Some(tree) = &model.tree {
        let robot = &model.robot;
        let root = code(&robot.links[tree.root].name);
        match tree.parent_joint[index] {
            None => lines.push("- root link".to_owned()),
            Some(joint) => {
                let joint = &robot.joints[joint];
                lines.push(format!(
                    "- moved by joint {} ({}), on link {}",
                    code(&joint.name),
                    word(joint.joint_type),
                    code(&joint.parent)
                ));
                let pose = pose_words(model.poses.get(index)?);
                lines.push(format!("- pose in {root}, default configuration: {pose}"));
            }
        }
        let children = &tree.child_joints[index];
        let mut names: Vec<String> = children
            .iter()
            .take(MOST_CHILDREN)
            .map(|joint| code(&robot.joints[*joint].child))
            .collect();
        if children.len() > MOST_CHILDREN {
            names.push(format!("{} more", children.len() - MOST_CHILDREN));
        }
        let names = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
        lines.push(format!("- children: {names}"));
    }
    lines.push(format!("- {} visual, {} collision", link.visual.len(), link.collision.len()));
    Some(lines.join("\n"))
}

fn pose_words(pose: &Isometry3<f64>) -> String {
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    format!(
        "xyz {} m, rpy {} rad",
        triple(pose.translation.vector.into()),
        triple([roll, pitch, yaw])
    )
}

fn triple(values: [f64; 3]) -> String {
    let value = |x: f64| number(if x.abs() < ZERO { 0.0 } else { x }, DIGITS);
    values.map(value).join(" ")
}

fn joint(model: &RobotModel, name: &str) -> Option<String> {
    let joint = &model.robot.joints[model.robot.joint(name)?];
    let mut lines = vec![
        format!("**joint {}**: {}\n", code(name), word(joint.joint_type)),
        format!("- {} → {}", code(&joint.parent), code(&joint.child)),
    ];
    if joint.has_axis() {
        lines.push(format!("- axis: {}", triple(joint.axis)));
    }
    lines.extend(limits(joint));
    if let Some(mimic) = &joint.mimic {
        let ignored = match joint.active_mimic() {
            Some(_) => "",
            None => " (ignored: the joint is fixed)",
        };
        lines.push(format!(
            "- mimics {}: position = {} × its position + {}{ignored}",
            code(&mimic.joint),
            number(mimic.multiplier, DIGITS),
            number(mimic.offset, DIGITS)
        ));
    }
    Some(lines.join("\n"))
}

/// A joint of a text that describes no robot, such as a xacro file.
fn joint_as_written(snapshot: &Snapshot, name: &str) -> Option<String> {
    let joint = snapshot.outline().joint(name)?;
    let kind = match joint.kind.as_str() {
        "" => String::new(),
        kind => format!(": {}", code(kind)),
    };
    let (parent, child) = (code(&joint.parent), code(&joint.child));
    Some(format!("**joint {}**{kind}\n\n- {parent} → {child}", code(name)))
}

fn limits(joint: &Joint) -> Vec<String> {
    let is_turn = matches!(joint.joint_type, JointType::Revolute | JointType::Continuous);
    let unit = if is_turn { "rad" } else { "m" };
    let mut lines = Vec::new();
    if let Some((lower, upper)) = joint.position_limits() {
        let mut line =
            format!("- limits: {} to {} {unit}", number(lower, DIGITS), number(upper, DIGITS));
        if is_turn {
            let degrees = |x: f64| number(x.to_degrees(), DIGITS);
            line += &format!(" ({}° to {}°)", degrees(lower), degrees(upper));
        }
        lines.push(line);
    }
    let Some(limit) = joint.limit.filter(|_| joint.has_axis()) else {
        return lines;
    };
    if let Some(velocity) = limit.velocity {
        let mut line = format!("- velocity: {} {unit}/s", number(velocity, DIGITS));
        if is_turn {
            line += &format!(" ({}°/s)", number(velocity.to_degrees(), DIGITS));
        }
        lines.push(line);
    }
    if let Some(effort) = limit.effort {
        let unit = if is_turn { "N m" } else { "N" };
        lines.push(format!("- effort: {} {unit}", number(effort, DIGITS)));
    }
    lines
}

fn word(kind: JointType) -> String {
    kind.as_str().to_lowercase()
}

fn mesh(model: Option<&RobotModel>, snapshot: &Snapshot, name: &str, element: usize) -> String {
    let title = format!("**mesh {}**\n\n", code(name));
    let meshes = model.map(|model| model.source.meshes.iter());
    let mesh = meshes.and_then(|mut meshes| meshes.find(|mesh| mesh.filename == name));
    let (Some(model), Some(mesh)) = (model, mesh) else {
        return title + "Not looked for: the text does not describe a robot yet.";
    };
    let file = match &mesh.file {
        Ok(file) => file,
        Err(missing) => return title + "Not found: " + &escape::line(&missing.reason),
    };
    let mut lines = vec![format!("- file: {}", code(&file.display().to_string()))];
    match fs::metadata(file) {
        Ok(metadata) => lines.push(format!("- size: {} bytes", metadata.len())),
        Err(error) => lines.push(format!("- not readable: {error}")),
    }
    match model.source.read(file) {
        Ok(scene) => {
            lines.push(format!("- triangles: {}", scene.triangle_count()));
            let scale = scale(snapshot, element);
            lines.extend(extent(&scene.merged(), scale));
            if scale != [1.0; 3] {
                lines.push(format!("- scale: {}", lengths(scale)));
            }
        }
        Err(reason) => lines.push(format!("- no usable surface: {}", escape::line(&reason))),
    }
    title + &lines.join("\n")
}

fn extent(mesh: &Mesh, scale: [f64; 3]) -> Option<String> {
    let bounds = mesh.bounds()?;
    let ends = |pick: fn(f64, f64) -> f64| {
        let axes = [0, 1, 2];
        axes.map(|axis| pick(bounds.min[axis] * scale[axis], bounds.max[axis] * scale[axis]))
    };
    let (low, high) = (ends(f64::min), ends(f64::max));
    let size = [0, 1, 2].map(|axis| number(high[axis] - low[axis], MESH_DIGITS)).join(" × ");
    Some(format!("- bounding box: {size} m, from ({}) to ({})", lengths(low), lengths(high)))
}

fn lengths(values: [f64; 3]) -> String {
    values.map(|value| number(value, MESH_DIGITS)).join(" ")
}

/// The scale that the element has; 1 where it has none that can be read.
fn scale(snapshot: &Snapshot, element: usize) -> [f64; 3] {
    let text = snapshot.text.as_str();
    let value = snapshot.markup().value(text, element, "scale");
    let words = value.as_deref().unwrap_or_default().split_whitespace();
    let factors: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
    factors.and_then(|factors| factors.try_into().ok()).unwrap_or([1.0; 3])
}
