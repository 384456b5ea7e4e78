//! SDF, for Gazebo and Drake: links, joints, the URDD's shapes as collisions, mimics, and Drake's collision filters.
//!
//! A joint's pose is given in its parent link and a link's pose in its joint, as in a URDF. Planar and floating joints
//! are chains of simple joints with light links between them. SDF takes a link without `<inertial>` for 1 kg, so that
//! links without mass get the smallest that its reader accepts.

mod gazebo;
mod joints;

use crate::inertia::{held, mean};
use crate::meshes::looks;
use crate::shapes::thick;
use crate::urdf_elements::{INERTIA, sizes};
use crate::{
    Export, ExportError, Files, MeshFiles, MeshFormat, Note, Shape, Solid, Subject, Taken, drake,
};
use gazebo::{Gazebo, Place};
use joints::{Joints, placed};
use urdd_document::robot::Inertial;
use urdd_geometry::primitives::Primitive;
use urdd_kinematics::rotation::to_rpy;
use urdd_xml::number::{number, numbers};
use urdd_xml::writer::Element;

const GAZEBO: &str = "Gazebo knows no pairs that need no check; the links do not collide with each other there (`<self_collide>` is off). Drake reads the pairs";
const WORLD: &str = "the root link is called `world`, which is SDF's own and has neither mass nor shapes; its own are left out";

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let mut notes = Vec::new();
    let name = if subject.urdf.name.is_empty() { "robot" } else { &subject.urdf.name };
    let mut model = Element::new("model").with("name", name);
    let root = subject.tree.root;
    let is_world = subject.is_world(root);
    let gazebo = Gazebo::new(subject, &mut notes);
    let mut taken = subject.names.taken.clone();
    gazebo.add("", Place::Model, &mut model, &mut taken, &mut notes);
    let mut joints = joints::joints(subject, taken, &gazebo, &mut notes)?;
    let (links, files) = links(subject, &joints, &gazebo, &mut notes)?;
    for (link, element) in links.into_iter().enumerate() {
        if link == root && is_world {
            notes.push(Note::Robot(WORLD));
        } else {
            model.push(element);
        }
    }
    if !is_world && !subject.is_floating {
        let name = joints.taken.free("world_fixed".to_owned());
        let world = Element::new("joint").with("name", name).with("type", "fixed");
        let parent = Element::text("parent", "world");
        let child = Element::text("child", &subject.links[root]);
        model.push(world.holding(parent).holding(child));
    }
    model.extend(std::mem::take(&mut joints.elements));
    model.extend(joints::loops(subject, &mut joints.taken, &mut notes)?);
    model.extend(drake::groups(subject, &mut joints.taken));
    if subject.disabled().next().is_some() {
        notes.push(Note::Robot(GAZEBO));
    }
    notes.extend(subject.notes());
    // Mimics came with 1.11, which libsdformat 14 (Gazebo Harmonic) and Drake read.
    let version = if joints.has_mimics { "1.11" } else { "1.9" };
    let sdf = Element::new("sdf")
        .with("version", version)
        .with("xmlns:drake", "http://drake.mit.edu")
        .holding(model);
    let what = format!("Collision geometry: {}.", subject.shapes);
    let text = sdf.document(&subject.comments(what, &notes)?);
    Ok(Export::of(text, files, notes))
}

/// Mass and moments of inertia of links without them, kg and kg m².
const LEAST: f64 = 1e-6;

const MASSLESS: &str =
    "no mass: exported with 1e-6 kg and 1e-6 kg m2, since SDF takes a link without mass for 1 kg";

const IMPOSSIBLE: &str = "moments of inertia that no body has, which SDF refuses: exported with their mean in all directions, or 1e-6 kg m2";

/// The links in link order, then those between the parts of joints; and the files that they reference.
fn links(
    subject: &Subject,
    joints: &Joints,
    gazebo: &Gazebo,
    notes: &mut Vec<Note>,
) -> Result<(Vec<Element>, Files), ExportError> {
    let shapes = subject.shapes_by_link()?;
    if shapes.iter().all(Vec::is_empty) {
        notes.push(Note::NoShapes(subject.shapes));
    }
    let mut files = MeshFiles::new(subject);
    let mut elements = Vec::new();
    let [mut massless, mut impossible] = [Vec::new(), Vec::new()];
    let looks = looks(subject, notes)?;
    let each = shapes.into_iter().zip(looks.meshes.into_iter().zip(looks.primitives));
    for (link, (shapes, (looks, primitives))) in each.enumerate() {
        if subject.is_frame(link) {
            elements.push(frame(subject, link));
            continue;
        }
        let view = &subject.view.links[link];
        let joint = subject.tree.parent_joint[link];
        let joint = joint.map(|joint| joints.last_parts[joint].as_str());
        let mut element = empty(&view.name, joint);
        let mut taken = Taken::default();
        gazebo.add(&view.name, Place::Link, &mut element, &mut taken, notes);
        element.push(
            match view.inertial.as_ref().filter(|of| of.mass.is_some_and(|mass| mass > 0.0)) {
                Some(of) => {
                    let (element, is_changed) = inertial(of);
                    if is_changed {
                        impossible.push(view.name.clone());
                    }
                    element
                }
                None => {
                    if !subject.is_world(link) {
                        massless.push(view.name.clone());
                    }
                    light()
                }
            },
        );
        let mut add =
            |what: String, pose: Option<Element>, geometry: Element, rgba: Option<[f64; 4]>| {
                let mut visual = Element::new("visual").with("name", taken.free(what));
                visual.extend(pose);
                visual.push(Element::new("geometry").holding(geometry));
                visual.extend(rgba.map(material));
                gazebo.add(&view.name, Place::Visual, &mut visual, &mut taken, notes);
                element.push(visual);
            };
        for (place, look) in looks.into_iter().enumerate() {
            let rgba = look.part.color;
            let (path, _) = files.add_look(link, place, look)?;
            add(format!("visual_{place}"), None, mesh(&path), rgba);
        }
        for (place, of) in primitives.into_iter().enumerate() {
            let pose = Some(placed(&of.pose));
            add(format!("primitive_{place}"), pose, element_of_primitive(of.primitive), of.color);
        }
        let mut names = Vec::new();
        for shape in shapes {
            let piece = shape.number;
            names.push(taken.free(format!("piece_{piece}")));
            let mut collision = collision(subject, link, shape, &mut files)?;
            collision.set("name", names.last().map(String::as_str));
            let said = &subject.links[subject.layout.source(link, piece)];
            gazebo.add(said, Place::Collision, &mut collision, &mut taken, notes);
            element.push(collision);
        }
        touch(&mut element, &names);
        elements.push(element);
    }
    notes.extend(Note::links(massless, MASSLESS));
    notes.extend(Note::links(impossible, IMPOSSIBLE));
    for (name, joint) in &joints.links {
        elements.push(empty(name, Some(joint)).holding(light()));
    }
    Ok((elements, files.into_files()))
}

/// Contact sensors that name a collision of the source have all collisions of their link.
fn touch(link: &mut Element, collisions: &[String]) {
    for sensor in link.elements_mut().filter(|element| element.name() == "sensor") {
        if let Some(contact) = sensor.child_mut("contact")
            && contact.child_mut("collision").is_some()
        {
            contact.remove("collision");
            for name in collisions {
                contact.push(Element::text("collision", name));
            }
        }
    }
}

fn frame(subject: &Subject, link: usize) -> Element {
    let frame = Element::new("frame").with("name", subject.links[link].as_str());
    let on = subject.tree.parent_link[link].map(|parent| subject.links[parent].as_str());
    let joint = subject.tree.parent_joint[link].map(|joint| &subject.view.joints[joint]);
    let pose = joint.map(|joint| placed(&joint.origin.motion()));
    pose.into_iter().fold(frame.with_some("attached_to", on), Element::holding)
}

/// A link at its joint.
fn empty(name: &str, joint: Option<&str>) -> Element {
    let mut element = Element::new("link").with("name", name);
    if let Some(joint) = joint {
        let pose = Element::new("pose").with("relative_to", joint);
        element.push(pose.containing("0 0 0 0 0 0"));
    }
    element
}

/// The mass properties, and whether the moments of inertia had to be changed.
fn inertial(of: &Inertial) -> (Element, bool) {
    let [roll, pitch, yaw] = to_rpy(&of.origin.rotation());
    let [x, y, z] = of.origin.xyz;
    let pose = numbers(&[x, y, z, roll, pitch, yaw]);
    let mass = of.mass.unwrap_or(0.0);
    let inertia = of.inertia.unwrap_or_default();
    let held = held(inertia, true).filter(|[xx, _, _, yy, _, zz]| xx.min(*yy).min(*zz) > 0.0);
    let mean = Some(mean(inertia)).filter(|mean| *mean > 0.0).unwrap_or(LEAST);
    let tensor = held.unwrap_or([mean, 0.0, 0.0, mean, 0.0, mean]);
    (self::tensor(&pose, mass, tensor), held.is_none())
}

fn light() -> Element {
    tensor("0 0 0 0 0 0", LEAST, [LEAST, 0.0, 0.0, LEAST, 0.0, LEAST])
}

fn tensor(pose: &str, mass: f64, inertia: [f64; 6]) -> Element {
    let mut tensor = Element::new("inertia");
    for (name, value) in INERTIA.into_iter().zip(inertia) {
        tensor.push(Element::text(name, &number(value)));
    }
    Element::new("inertial")
        .holding(Element::text("pose", pose))
        .holding(Element::text("mass", &number(mass)))
        .holding(tensor)
}

fn material(rgba: [f64; 4]) -> Element {
    let colour = numbers(&rgba);
    let ambient = Element::text("ambient", &colour);
    let diffuse = Element::text("diffuse", &colour);
    Element::new("material").holding(ambient).holding(diffuse)
}

fn mesh(path: &str) -> Element {
    Element::new("mesh").holding(Element::text("uri", path))
}

fn collision(
    subject: &Subject,
    link: usize,
    shape: Shape,
    files: &mut MeshFiles,
) -> Result<Element, ExportError> {
    let name = format!("piece_{}", shape.number);
    let mut collision = Element::new("collision").with("name", name.as_str());
    let geometry = match shape.solid {
        Solid::Convex(solid) => {
            let path = files.add(link, &name, solid, MeshFormat::Obj)?;
            mesh(&path).holding(Element::new("drake:declare_convex"))
        }
        Solid::Mesh(solid) => mesh(&files.add(link, &name, solid, MeshFormat::Obj)?),
        Solid::Primitive(pose, primitive) => {
            collision.push(placed(&pose));
            element_of_primitive(primitive)
        }
    };
    collision.push(Element::new("geometry").holding(geometry));
    if let Some(friction) = subject.friction().map(number) {
        let ode = ["mu", "mu2"].map(|name| Element::text(name, &friction));
        let ode = ode.into_iter().fold(Element::new("ode"), Element::holding);
        let friction = Element::new("friction").holding(ode);
        collision.push(Element::new("surface").holding(friction));
    }
    Ok(collision)
}

fn element_of_primitive(primitive: Primitive) -> Element {
    let (tag, sizes) = sizes(thick(primitive));
    let sizes = sizes.into_iter().map(|(key, size)| Element::text(key, &size));
    sizes.fold(Element::new(tag), Element::holding)
}
