//! The elements of a URDF: links with the URDD's shapes, and joints.

use std::collections::BTreeMap;

use nalgebra::Isometry3;

use crate::inertia::{for_drake, held};
use crate::joints::without_quaternion;
use crate::layout::origin;
use crate::meshes::{Look, looks};
use crate::shapes::thick;
use crate::{ExportError, Files, MeshFiles, MeshFormat, Note, Painted, Shape, Solid, Subject};
use urdd_document::pose::has_quaternions;
use urdd_document::robot::Inertial as InertialView;
use urdd_format::urdf::{Geometry as Source, Inertial, Joint, JointType, Origin, Visual};
use urdd_geometry::primitives::Primitive;
use urdd_xml::number::{number, numbers};
use urdd_xml::other_parts::{OtherPart, Owner};
use urdd_xml::writer::Element;
use urdd_xml::{Document, Kind, Node, is_character};

/// The form of collision geometry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Geometry {
    /// For any URDF reader.
    Plain,
    /// For Drake: OBJ, declared as convex, and no flat boxes.
    Drake,
}

impl Geometry {
    /// The name of a visual or a collision element. Drake drops spaces and tabs around it, and refuses an empty one and
    /// two that differ in these alone; of two that are the same, it changes one.
    fn name(self, name: Option<&str>) -> Option<&str> {
        match self {
            Geometry::Plain => name,
            Geometry::Drake => {
                name.map(|of| of.trim_matches([' ', '\t'])).filter(|of| !of.is_empty())
            }
        }
    }
}

/// The empty `robot` element.
pub(super) fn empty_robot(subject: &Subject) -> Element {
    let mut robot = Element::new("robot")
        .with("name", subject.urdf.name.as_str())
        .with_some("version", sound(subject.urdf.version.as_deref()));
    add_attributes(subject, &Owner::Robot, &mut robot);
    robot
}

/// The links with these shapes, in link order, and the files that they reference.
pub(super) fn links(
    subject: &Subject,
    geometry: Geometry,
    shapes: Vec<Vec<Shape>>,
    notes: &mut Vec<Note>,
) -> Result<(Vec<Element>, Files), ExportError> {
    if shapes.iter().all(Vec::is_empty) {
        notes.push(Note::NoShapes(subject.shapes));
    }
    let quaternions = has_quaternions(subject.urdf.version.as_deref());
    let friction = subject.friction().filter(|_| geometry == Geometry::Drake);
    let mut files = MeshFiles::new(subject);
    let mut elements = Vec::new();
    let mut changed: BTreeMap<&'static str, Vec<String>> = BTreeMap::new();
    let each = subject.urdf.links.iter().zip(&subject.view.links);
    let looks = looks(subject, notes)?;
    let each = each.zip(shapes.into_iter().zip(looks.meshes.into_iter().zip(looks.primitives)));
    for (idx, ((link, view), (shapes, (looks, primitives)))) in each.enumerate() {
        let mut element = Element::new("link").with("name", link.name.as_str());
        if let Some((inertial, view)) = link.inertial.as_ref().zip(view.inertial.as_ref()) {
            let (inertial, said) = element_of_inertial(inertial, view, quaternions, geometry);
            element.push(inertial);
            if let Some(said) = said {
                changed.entry(said).or_default().push(link.name.clone());
            }
        }
        add_attributes(subject, &Owner::Link(link.name.clone()), &mut element);
        let is_mesh = |of: &&Visual| matches!(of.geometry, Some(Source::Mesh(_)));
        let of_looks = link.visual.iter().filter(|of| primitives.is_empty() || is_mesh(of));
        let mut names = of_looks.map(|visual| geometry.name(visual.name.as_deref()));
        for (look, place) in looks.into_iter().zip(0..) {
            let name = names.next().flatten();
            element.push(visual(idx, place, name, look, &mut files)?);
        }
        element.extend(primitives.into_iter().map(|of| painted(of, geometry)));
        for shape in shapes {
            let mut collision = collision(idx, shape, geometry, &mut files)?;
            if let Some(friction) = friction.map(number) {
                let mut properties = Element::new("drake:proximity_properties");
                for key in ["drake:mu_static", "drake:mu_dynamic"] {
                    properties.push(Element::new(key).with("value", friction.as_str()));
                }
                collision.push(properties);
            }
            element.push(collision);
        }
        elements.push(element);
    }
    notes.extend(changed.into_iter().map(|(what, links)| Note::Links { links, what }));
    Ok((elements, files.into_files()))
}

/// Adds elements that URDF does not define, as raw text. Returns how many cannot be included.
pub(super) fn push_unknown(element: &mut Element, texts: &[String], known: &[&str]) -> usize {
    let mut lost = 0;
    for text in texts {
        match document(text) {
            Some(document) if document.root_element().has_tag_name("mujoco") => {
                element.push_raw(for_mujoco(document.root_element()));
            }
            Some(document) if !known.contains(&document.root_element().tag_name().name()) => {
                element.push_raw(&text[document.root_element().range()]);
            }
            _ => lost += 1,
        }
    }
    lost
}

/// An element that URDF does not define, as a document; `None` if readers of XML differ about it.
pub(super) fn document(text: &str) -> Option<Document<'_>> {
    urdd_xml::parse(text, Kind::Other).ok()?;
    let document = urdd_xml::parse(text, Kind::Robot).ok()?;
    document.descendants().all(has_namespaces).then_some(document)
}

/// An element that is hardware of ros2_control, as a document.
pub(super) fn ros2_control(text: &str) -> Option<Document<'_>> {
    let document = urdd_xml::parse(text, Kind::Other).ok()?;
    document.root_element().has_tag_name("ros2_control").then_some(document)
}

/// A text that XML can hold: a URDF has no other, an edited module can.
fn sound(text: Option<&str>) -> Option<&str> {
    text.filter(|text| text.chars().all(is_character))
}

/// Whether the namespaces of an element are written as URIs. expat and libxml2 refuse a file with others.
fn has_namespaces(node: Node) -> bool {
    let is_of_uri = |c: char| c.is_ascii_alphanumeric() || "-._~:/?#[]@!&'()*+,;=%".contains(c);
    node.namespaces().all(|namespace| namespace.uri().chars().all(is_of_uri))
}

/// MuJoCo's own element of a URDF, with the meshes where they are now: MuJoCo looks for names without folders otherwise.
fn for_mujoco(node: Node) -> String {
    let mut element = Element::of(node);
    if element.has_prefix() {
        return node.document().input_text()[node.range()].to_owned();
    }
    element.say("compiler", "");
    if let Some(compiler) = element.child_mut("compiler") {
        for key in ["meshdir", "assetdir", "texturedir"] {
            compiler.set(key, None);
        }
        compiler.set("strippath", Some("false"));
    }
    element.fragment()
}

/// The elements that URDF defines in `robot`, `link` and `joint`.
pub(super) const IN_ROBOT: &[&str] = &["link", "joint", "material"];
pub(super) const IN_LINK: &[&str] = &["inertial", "visual", "collision"];
pub(super) const IN_JOINT: &[&str] = &[
    "origin",
    "parent",
    "child",
    "axis",
    "limit",
    "dynamics",
    "mimic",
    "safety_controller",
    "calibration",
];

/// The mass properties, and what had to be changed.
fn element_of_inertial(
    inertial: &Inertial,
    view: &InertialView,
    quaternions: bool,
    geometry: Geometry,
) -> (Element, Option<&'static str>) {
    let mut element = Element::new("inertial");
    if let Some(origin) = &inertial.origin {
        let plain = without_quaternion(origin, &view.origin, quaternions);
        element.push(element_of_origin(&plain));
    }
    // Most programs reject an element without one of these. Missing values are 0 (SPEC 6.1.8).
    let (mass, inertia) = (view.mass.unwrap_or(0.0), view.inertia.unwrap_or_default());
    let (mass, inertia, said) = match geometry {
        Geometry::Plain => (mass, held(inertia, false).unwrap_or(inertia), None),
        Geometry::Drake => for_drake(mass, inertia),
    };
    element.push(Element::new("mass").with("value", number(mass)));
    let inertia = INERTIA.into_iter().zip(inertia.map(Some));
    element.push(Element::new("inertia").with_numbers(inertia));
    (element, said)
}

/// The names of moments and products of inertia.
pub(super) const INERTIA: [&str; 6] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];

pub(super) fn element_of_origin(origin: &Origin) -> Element {
    Element::new("origin")
        .with_some("xyz", origin.xyz.map(|xyz| numbers(&xyz)))
        .with_some("rpy", origin.rpy.map(|rpy| numbers(&rpy)))
}

fn visual(
    link: usize,
    place: usize,
    name: Option<&str>,
    look: Look,
    files: &mut MeshFiles,
) -> Result<Element, ExportError> {
    let rgba = look.part.color;
    let (path, _) = files.add_look(link, place, look)?;
    let mesh = Element::new("mesh").with("filename", path);
    let visual = Element::new("visual").with_some("name", sound(name));
    let mut visual = visual.holding(Element::new("geometry").holding(mesh));
    visual.extend(rgba.map(material));
    Ok(visual)
}

fn material(rgba: [f64; 4]) -> Element {
    let color = Element::new("color").with("rgba", numbers(&rgba));
    let name = format!("rgba {}", numbers(&rgba));
    Element::new("material").with("name", name).holding(color)
}

fn painted(of: Painted, as_said: Geometry) -> Element {
    let mut visual =
        Element::new("visual").with_some("name", as_said.name(sound(of.name.as_deref())));
    visual.push(placed(&of.pose, &of.primitive));
    visual.push(Element::new("geometry").holding(element_of_primitive(of.primitive, as_said)));
    visual.extend(of.color.map(material));
    visual
}

fn collision(
    link: usize,
    shape: Shape,
    as_said: Geometry,
    files: &mut MeshFiles,
) -> Result<Element, ExportError> {
    let name = as_said.name(sound(shape.name.as_deref()));
    let mut collision = Element::new("collision").with_some("name", name);
    let is_convex = matches!(shape.solid, Solid::Convex(_));
    let geometry = match shape.solid {
        Solid::Convex(mesh) | Solid::Mesh(mesh) => {
            let format = match as_said {
                Geometry::Plain => MeshFormat::Stl,
                Geometry::Drake => MeshFormat::Obj,
            };
            let path = files.add(link, &format!("piece_{}", shape.number), mesh, format)?;
            let mut mesh = Element::new("mesh").with("filename", path);
            if as_said == Geometry::Drake && is_convex {
                mesh.push(Element::new("drake:declare_convex"));
            }
            mesh
        }
        Solid::Primitive(pose, primitive) => {
            collision.push(placed(&pose, &primitive));
            element_of_primitive(primitive, as_said)
        }
    };
    Ok(collision.holding(Element::new("geometry").holding(geometry)))
}

fn element_of_primitive(primitive: Primitive, as_said: Geometry) -> Element {
    let (tag, sizes) = match as_said {
        Geometry::Plain => sizes(primitive),
        Geometry::Drake => sizes(thick(primitive)),
    };
    let is_drakes = as_said == Geometry::Drake && tag == "capsule";
    let element = Element::new(if is_drakes { "drake:capsule" } else { tag });
    sizes.into_iter().fold(element, |element, (key, size)| element.with(key, size))
}

/// A primitive's word in URDF and SDF, and its sizes.
pub(super) fn sizes(primitive: Primitive) -> (&'static str, Vec<(&'static str, String)>) {
    let long = |radius, half: f64| vec![("radius", number(radius)), ("length", number(2.0 * half))];
    match primitive {
        Primitive::Box(half) => ("box", vec![("size", numbers(&half.map(|half| 2.0 * half)))]),
        Primitive::Cylinder { radius, half } => ("cylinder", long(radius, half)),
        Primitive::Capsule { radius, half } => ("capsule", long(radius, half)),
        Primitive::Sphere { radius } => ("sphere", vec![("radius", number(radius))]),
    }
}

/// The origin of a primitive. A sphere needs no rotation.
fn placed(pose: &Isometry3<f64>, primitive: &Primitive) -> Element {
    let origin = origin(pose);
    let is_turned = !matches!(primitive, Primitive::Sphere { .. });
    element_of_origin(&Origin { rpy: origin.rpy.filter(|_| is_turned), ..origin })
}

/// A joint element; `tag` and `kind` are the program's names of the element and the joint type.
pub(super) fn element_of_joint(joint: &Joint, tag: &'static str, kind: &str) -> Element {
    let mut element = Element::new(tag).with("name", joint.name.as_str()).with("type", kind);
    if let Some(origin) = &joint.origin {
        element.push(element_of_origin(origin));
    }
    element.push(Element::new("parent").with("link", joint.parent.link.as_str()));
    element.push(Element::new("child").with("link", joint.child.link.as_str()));
    if let Some(axis) = &joint.axis {
        element.push(Element::new("axis").with_some("xyz", axis.xyz.map(|xyz| numbers(&xyz))));
    }
    element.extend(joint.limit.as_ref().map(|of| {
        Element::new("limit").with_numbers([
            ("lower", of.lower),
            ("upper", of.upper),
            ("effort", of.effort),
            ("velocity", of.velocity),
            ("acceleration", of.acceleration),
            ("deceleration", of.deceleration),
            ("jerk", of.jerk),
        ])
    }));
    element.extend(joint.dynamics.as_ref().map(|of| {
        let values = [("damping", of.damping), ("friction", of.friction)];
        Element::new("dynamics").with_numbers(values)
    }));
    if let Some(of) = &joint.mimic {
        let values = [("multiplier", of.multiplier), ("offset", of.offset)];
        let mimic = Element::new("mimic").with("joint", of.joint.as_str());
        element.push(mimic.with_numbers(values));
    }
    if let Some(of) = &joint.safety_controller {
        let values = [
            ("soft_lower_limit", of.soft_lower_limit),
            ("soft_upper_limit", of.soft_upper_limit),
            ("k_position", of.k_position),
            ("k_velocity", of.k_velocity),
        ];
        element.push(Element::new("safety_controller").with_numbers(values));
    }
    if let Some(of) = &joint.calibration {
        let values = [("rising", of.rising), ("falling", of.falling)];
        element.push(Element::new("calibration").with_numbers(values));
    }
    element
}

/// URDF's word for a type of joint.
pub(super) fn type_name(joint_type: JointType) -> String {
    joint_type.as_str().to_ascii_lowercase()
}

/// Whether a URDF has a part: an attribute, but for those of shapes and materials, which are the file's own.
pub(super) fn is_kept(part: &OtherPart) -> bool {
    let own = ["visual", "collision", "material"];
    part.is_attribute
        && !part.name.contains(':')
        && !own.iter().any(|own| part.path.starts_with(own))
}

/// Adds the attributes of the robot, a link or a joint to its element.
pub(super) fn add_attributes(subject: &Subject, owner: &Owner, element: &mut Element) {
    let parts = subject.other_parts.get(owner).into_iter().flatten();
    for part in parts.filter(|part| is_kept(part)) {
        let mut path = part.path.split('/').filter(|tag| !tag.is_empty());
        if let Some(at) = path.try_fold(&mut *element, |at, tag| at.child_mut(tag)) {
            at.set(&part.name, Some(&part.value));
        }
    }
}
