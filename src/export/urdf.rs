//! URDF: the robot as its source has it, with our shapes as collision geometry.

use nalgebra::{Isometry3, Vector3};

use super::Export;
use super::element::Element;
use super::error::{ExportError, Note};
use super::meshes::{Look, MeshFiles, MeshFormat, looks};
use super::numbers::{number, numbers};
use super::subject::Subject;
use crate::format::urdf::{Inertial, Joint, JointType, Link, Origin};
use crate::robot::{LinkShape, Solid};

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let (robot, files, notes) = robot(subject, Dialect::Plain)?;
    let mut comments = subject.origin()?;
    comments.push(format!("Collision geometry: {}.", subject.options.shapes));
    Ok(Export {
        text: robot.document(&comments),
        files,
        notes,
    })
}

/// For whom the URDF is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Dialect {
    /// Any reader.
    Plain,
    /// Drake, which reads OBJ, and takes a mesh for convex where it is told so.
    Drake,
}

type Robot = (Element, Vec<(String, Vec<u8>)>, Vec<Note>);

/// The `robot` element, the files that it names, and what is to be said.
pub(super) fn robot(subject: &Subject, dialect: Dialect) -> Result<Robot, ExportError> {
    let urdf = &subject.urdf;
    let mut robot = Element::new("robot")
        .with("name", urdf.name.as_str())
        .with_some("version", urdf.version.as_deref());
    if dialect == Dialect::Drake {
        robot = robot.with("xmlns:drake", "http://drake.mit.edu");
    }
    let shapes = subject.shapes_by_link(subject.options.shapes)?;
    let mut files = MeshFiles::new(subject);
    let mut lost = 0;
    let looks = looks(subject)?;
    for (idx, ((link, shapes), looks)) in urdf.links.iter().zip(shapes).zip(looks).enumerate() {
        let mut element = element_of_link(link);
        for (look, place) in looks.into_iter().zip(0..) {
            element.push(visual(idx, place, look, &mut files)?);
        }
        for shape in shapes {
            element.push(collision(idx, shape, dialect, &mut files)?);
        }
        lost += push_unknown(&mut element, &link.unknown_elements);
        robot.push(element);
    }
    for joint in &urdf.joints {
        let mut element = element_of_joint(joint);
        lost += push_unknown(&mut element, &joint.unknown_elements);
        robot.push(element);
    }
    lost += push_unknown(&mut robot, &urdf.unknown_elements);
    let mut notes = subject.notes();
    if lost > 0 {
        notes.push(Note::Elements(lost));
    }
    Ok((robot, files.into_files(), notes))
}

/// Elements that URDF does not define, as their own text. How many cannot stand here.
fn push_unknown(element: &mut Element, texts: &[String]) -> usize {
    let mut lost = 0;
    for text in texts {
        match roxmltree::Document::parse(text) {
            Ok(_) => element.push_raw(text),
            Err(_) => lost += 1,
        }
    }
    lost
}

fn element_of_link(link: &Link) -> Element {
    let mut element = Element::new("link").with("name", link.name.as_str());
    if let Some(inertial) = &link.inertial {
        element.push(element_of_inertial(inertial));
    }
    element
}

fn element_of_inertial(inertial: &Inertial) -> Element {
    let mut element = Element::new("inertial");
    if let Some(origin) = &inertial.origin {
        element.push(element_of_origin(origin));
    }
    if let Some(mass) = &inertial.mass {
        element.push(Element::new("mass").with("value", number(mass.value)));
    }
    if let Some(i) = &inertial.inertia {
        element.push(
            Element::new("inertia")
                .with_some("ixx", i.ixx.map(number))
                .with_some("ixy", i.ixy.map(number))
                .with_some("ixz", i.ixz.map(number))
                .with_some("iyy", i.iyy.map(number))
                .with_some("iyz", i.iyz.map(number))
                .with_some("izz", i.izz.map(number)),
        );
    }
    element
}

fn element_of_origin(origin: &Origin) -> Element {
    Element::new("origin")
        .with_some("xyz", origin.xyz.map(|xyz| numbers(&xyz)))
        .with_some("rpy", origin.rpy.map(|rpy| numbers(&rpy)))
        .with_some("quat_xyzw", origin.quat_xyzw.map(|quat| numbers(&quat)))
}

fn visual(
    link: usize,
    place: usize,
    look: Look,
    files: &mut MeshFiles,
) -> Result<Element, ExportError> {
    let what = format!("visual_{place}");
    let path = files.add(link, &what, look.mesh, MeshFormat::Obj)?;
    let mesh = Element::new("mesh").with("filename", path);
    let mut visual = Element::new("visual").holding(Element::new("geometry").holding(mesh));
    if let Some(rgba) = look.rgba {
        let color = Element::new("color").with("rgba", numbers(&rgba));
        let name = format!("rgba {}", numbers(&rgba));
        visual.push(Element::new("material").with("name", name).holding(color));
    }
    Ok(visual)
}

fn collision(
    link: usize,
    shape: LinkShape,
    dialect: Dialect,
    files: &mut MeshFiles,
) -> Result<Element, ExportError> {
    let mut collision = Element::new("collision");
    let geometry = match shape.solid {
        Solid::Mesh(mesh) => {
            let format = match dialect {
                Dialect::Plain => MeshFormat::Stl,
                Dialect::Drake => MeshFormat::Obj,
            };
            let path = files.add(link, &format!("piece_{}", shape.piece), mesh, format)?;
            let mut mesh = Element::new("mesh").with("filename", path);
            if dialect == Dialect::Drake {
                mesh.push(Element::new("drake:declare_convex"));
            }
            mesh
        }
        Solid::Box { pose, half_extents } => {
            collision.push(placed(&pose));
            let size = half_extents.map(|half| 2.0 * half);
            Element::new("box").with("size", numbers(&size))
        }
        Solid::Sphere { centre, radius } => {
            collision.push(Element::new("origin").with("xyz", numbers(&centre)));
            Element::new("sphere").with("radius", number(radius))
        }
    };
    Ok(collision.holding(Element::new("geometry").holding(geometry)))
}

fn placed(pose: &Isometry3<f64>) -> Element {
    let position: Vector3<f64> = pose.translation.vector;
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    Element::new("origin")
        .with("xyz", numbers(&[position.x, position.y, position.z]))
        .with("rpy", numbers(&[roll, pitch, yaw]))
}

fn element_of_joint(joint: &Joint) -> Element {
    let mut element = Element::new("joint")
        .with("name", joint.name.as_str())
        .with("type", type_name(joint.joint_type));
    if let Some(origin) = &joint.origin {
        element.push(element_of_origin(origin));
    }
    element.push(Element::new("parent").with("link", joint.parent.link.as_str()));
    element.push(Element::new("child").with("link", joint.child.link.as_str()));
    if let Some(axis) = &joint.axis {
        element.push(Element::new("axis").with_some("xyz", axis.xyz.map(|xyz| numbers(&xyz))));
    }
    if let Some(limit) = &joint.limit {
        element.push(
            Element::new("limit")
                .with_some("lower", limit.lower.map(number))
                .with_some("upper", limit.upper.map(number))
                .with_some("effort", limit.effort.map(number))
                .with_some("velocity", limit.velocity.map(number))
                .with_some("acceleration", limit.acceleration.map(number))
                .with_some("deceleration", limit.deceleration.map(number))
                .with_some("jerk", limit.jerk.map(number)),
        );
    }
    if let Some(dynamics) = &joint.dynamics {
        element.push(
            Element::new("dynamics")
                .with_some("damping", dynamics.damping.map(number))
                .with_some("friction", dynamics.friction.map(number)),
        );
    }
    if let Some(mimic) = &joint.mimic {
        element.push(
            Element::new("mimic")
                .with("joint", mimic.joint.as_str())
                .with_some("multiplier", mimic.multiplier.map(number))
                .with_some("offset", mimic.offset.map(number)),
        );
    }
    if let Some(safety) = &joint.safety_controller {
        element.push(
            Element::new("safety_controller")
                .with_some("soft_lower_limit", safety.soft_lower_limit.map(number))
                .with_some("soft_upper_limit", safety.soft_upper_limit.map(number))
                .with_some("k_position", safety.k_position.map(number))
                .with_some("k_velocity", safety.k_velocity.map(number)),
        );
    }
    if let Some(calibration) = &joint.calibration {
        element.push(
            Element::new("calibration")
                .with_some("rising", calibration.rising.map(number))
                .with_some("falling", calibration.falling.map(number)),
        );
    }
    element
}

fn type_name(joint_type: JointType) -> &'static str {
    match joint_type {
        JointType::Revolute => "revolute",
        JointType::Continuous => "continuous",
        JointType::Prismatic => "prismatic",
        JointType::Fixed => "fixed",
        JointType::Floating => "floating",
        JointType::Planar => "planar",
        JointType::Spherical => "spherical",
    }
}
