//! Bodies: one for each link, nested in that of its parent.

use std::collections::HashSet;

use nalgebra::Isometry3;

use crate::gains::positive;
use crate::inertia::{MIN_VALUE, Mass, Odd, mass};
use crate::meshes::{Looks, looks};
use crate::names::last;
use crate::shapes::thick;
use crate::{
    ExportError, FlatShapes, MeshFiles, MeshFormat, Moves, Note, Shape, Solid, Subject, meshes,
};
use urdd_document::tree::RigidGroups;
use urdd_format::urdf::JointType;
use urdd_geometry::primitives::Primitive;
use urdd_xml::number::{number, numbers};
use urdd_xml::writer::Element;

const FLOATING_BASE: &str = "floating_base";

const INVISIBLE: &str = "visual geometry without area, which MuJoCo refuses; it is left out";

pub(super) struct Bodies<'a> {
    subject: &'a Subject<'a>,
    shapes: Vec<Vec<Shape>>,
    looks: Looks,
    flat: FlatShapes,
    pub files: MeshFiles<'a>,
    pub assets: Element,
    /// Paths that already have an asset.
    named: HashSet<String>,
    inertials: Vec<Option<Element>>,
    /// For each link, sites besides its own.
    pub sites: Vec<Vec<Element>>,
    /// Links with visual geometry that is left out.
    invisible: Vec<String>,
    /// Whether moments of inertia violate the triangle inequality.
    pub balanced: bool,
    pub notes: Vec<Note>,
}

impl<'a> Bodies<'a> {
    pub fn new(subject: &'a Subject<'a>) -> Result<Self, ExportError> {
        let shapes = subject.shapes_by_link()?;
        let mut notes = Vec::new();
        if shapes.iter().all(Vec::is_empty) {
            notes.push(Note::NoShapes(subject.shapes));
        }
        let (inertials, balanced) = inertials(subject, &mut notes);
        Ok(Bodies {
            subject,
            shapes,
            looks: looks(subject, &mut notes)?,
            flat: FlatShapes::new(subject)?,
            files: MeshFiles::new(subject),
            assets: Element::new("asset"),
            named: HashSet::new(),
            inertials,
            invisible: Vec::new(),
            sites: vec![Vec::new(); subject.links.len()],
            balanced,
            notes,
        })
    }

    /// The `worldbody` with all bodies. A free base starts at `base_height`, m.
    pub fn world(&mut self, base_height: f64) -> Result<Element, ExportError> {
        let world = Element::new("worldbody");
        let root = self.subject.tree.root;
        let mut elements: Vec<Option<Element>> = self.subject.links.iter().map(|_| None).collect();
        // From the leaves up, to avoid deep recursion for long chains.
        for &link in self.subject.tree.order.iter().rev() {
            let mut element = if self.subject.is_world(link) {
                world.clone()
            } else {
                self.frame(link, base_height)
            };
            if !self.subject.is_frame(link) {
                self.fill(link, &mut element)?;
            }
            for joint in &self.subject.tree.child_joints[link] {
                let child = self.subject.tree.joint_links[*joint].1;
                if let Some(child) = elements[child].take() {
                    element.push(child);
                }
            }
            elements[link] = Some(element);
        }
        self.invisible.dedup();
        self.notes.extend(Note::links(std::mem::take(&mut self.invisible), INVISIBLE));
        Ok(match elements[root].take() {
            Some(element) if self.subject.is_world(root) => element,
            Some(element) => world.holding(element),
            None => world,
        })
    }

    /// A body at the origin of its joint, or a site for what is but a frame.
    fn frame(&self, link: usize, base_height: f64) -> Element {
        let name = self.subject.links[link].as_str();
        let body = match self.subject.is_frame(link) {
            true => site_named(name),
            false => Element::new("body").with("name", name),
        };
        let Some(joint) = self.subject.tree.parent_joint[link] else {
            return if self.subject.has_free_base() {
                body.with("pos", numbers(&[0.0, 0.0, base_height]))
            } else {
                body
            };
        };
        let origin = &self.subject.view.joints[joint].origin;
        placed(body, &origin.motion())
    }

    /// Adds mass, joints and geoms.
    fn fill(&mut self, link: usize, element: &mut Element) -> Result<(), ExportError> {
        let subject = self.subject;
        let mut joints = Vec::new();
        if let Some(joint) = subject.tree.parent_joint[link] {
            joints = joints_of(subject, joint, &mut self.notes);
        }
        if let Some(inertial) = self.inertials[link].take()
            && !self.subject.is_world(link)
        {
            element.push(inertial);
        }
        if link == subject.tree.root && subject.has_free_base() {
            let name = subject.names.taken.untaken(FLOATING_BASE.to_owned());
            element.push(Element::new("freejoint").with("name", name));
        }
        element.extend(joints);
        element.extend(site(subject, self.subject.options.chosen.sensors, link));
        element.extend(std::mem::take(&mut self.sites[link]));
        for (mut look, place) in std::mem::take(&mut self.looks.meshes[link]).into_iter().zip(0..) {
            if !meshes::complete(&mut look.part.mesh) {
                self.invisible.push(subject.links[link].clone());
                continue;
            }
            let count = look.part.mesh.vertices.len();
            look.part.texture.iter_mut().for_each(|texture| texture.uv.resize(count, [0.0; 2]));
            let rgba = look.part.color.map(|rgba| numbers(&rgba));
            let (path, texture) = self.files.add_look(link, place, look)?;
            let asset = self.asset(path, MeshFormat::Obj);
            let geom = Element::new("geom")
                .with("class", "visual")
                .with("type", "mesh")
                .with("mesh", asset)
                .with_some("rgba", rgba)
                .with_some("material", texture.map(|path| self.material(path)));
            element.push(geom);
        }
        for of in std::mem::take(&mut self.looks.primitives[link]) {
            let geom = Element::new("geom").with("class", "visual");
            let rgba = of.color.map(|rgba| numbers(&rgba));
            element.push(primitive(geom, &of.pose, of.primitive).with_some("rgba", rgba));
        }
        for shape in std::mem::take(&mut self.shapes[link]) {
            let geom = self.geom(link, shape)?;
            element.push(geom);
        }
        Ok(())
    }

    fn geom(&mut self, link: usize, shape: Shape) -> Result<Element, ExportError> {
        let name = geom_name(&self.subject.links[link], shape.number);
        let geom = Element::new("geom").with("name", name).with("class", "collision");
        Ok(match shape.solid {
            Solid::Convex(mesh) | Solid::Mesh(mesh) if meshes::is_flat(&mesh) => {
                let (pose, cuboid) = self.flat.cuboid(&mesh, shape.number, link, &mut self.notes);
                primitive(geom, &pose, cuboid)
            }
            Solid::Convex(mesh) | Solid::Mesh(mesh) => {
                let what = format!("piece_{}", shape.number);
                let format =
                    if meshes::fits_stl(&mesh) { MeshFormat::Stl } else { MeshFormat::Obj };
                let path = self.files.add(link, &what, mesh, format)?;
                let asset = self.asset(path, format);
                geom.with("type", "mesh").with("mesh", asset)
            }
            Solid::Primitive(pose, of) => primitive(geom, &pose, of),
        })
    }

    fn asset(&mut self, path: String, format: MeshFormat) -> String {
        let name = stem(&path);
        if !self.named.insert(path.clone()) {
            return name;
        }
        let mut asset = Element::new("mesh").with("name", name.as_str()).with("file", path);
        if format == MeshFormat::Obj {
            // Visual meshes need not enclose a volume.
            asset = asset.with("inertia", "shell");
        }
        self.assets.push(asset);
        name
    }

    fn material(&mut self, path: String) -> String {
        let name = stem(&path);
        if self.named.insert(path.clone()) {
            let named = |tag| Element::new(tag).with("name", name.as_str());
            self.assets.push(named("texture").with("type", "2d").with("file", path));
            self.assets.push(named("material").with("texture", name.as_str()));
        }
        name
    }
}

/// The name of a file without folder and ending, as unique as the file's.
fn stem(path: &str) -> String {
    let file = last(path);
    file.rsplit_once('.').map_or(file, |(stem, _)| stem).to_owned()
}

/// The name of a shape's geom: unique for any link names.
pub(super) fn geom_name(link: &str, piece: usize) -> String {
    format!("{link}/{piece}")
}

fn primitive(geom: Element, pose: &Isometry3<f64>, primitive: Primitive) -> Element {
    let (kind, size) = match thick(primitive) {
        Primitive::Box(half) => ("box", half.to_vec()),
        Primitive::Cylinder { radius, half } => ("cylinder", vec![radius, half]),
        Primitive::Capsule { radius, half } => ("capsule", vec![radius, half]),
        Primitive::Sphere { radius } => ("sphere", vec![radius]),
    };
    let geom = geom.with("type", kind);
    let geom = match kind {
        "sphere" => geom.with("pos", numbers(pose.translation.vector.as_slice())),
        _ => placed(geom, pose),
    };
    geom.with("size", numbers(&size))
}

pub(super) fn placed(element: Element, pose: &Isometry3<f64>) -> Element {
    let position = pose.translation.vector;
    let q = pose.rotation.quaternion();
    element.with("pos", numbers(position.as_slice())).with("quat", numbers(&[q.w, q.i, q.j, q.k]))
}

/// The site of a link, if its frame is that of a tool, or of an IMU with sensors.
fn site(subject: &Subject, sensors: bool, link: usize) -> Option<Element> {
    let setup = subject.given.as_ref()?;
    let is_imu = sensors && setup.imus.value.contains(&link);
    (is_imu || setup.tools.value.contains(&link)).then(|| site_named(&subject.links[link]))
}

pub(super) fn site_named(frame: &str) -> Element {
    Element::new("site").with("name", frame).with("group", "4")
}

/// A gyroscope and an accelerometer at each IMU.
pub(super) fn sensors(subject: &Subject) -> Element {
    let mut sensors = Element::new("sensor");
    for &link in subject.given.iter().flat_map(|setup| &setup.imus.value) {
        let site = subject.links[link].as_str();
        for kind in ["gyro", "accelerometer"] {
            let sensor = Element::new(kind).with("name", format!("{site}/{kind}"));
            sensors.push(sensor.with("site", site));
        }
    }
    sensors
}

const LOCKED: &str = "its limits are equal, which MuJoCo refuses; an equality constraint holds it there, and it has no actuator";

const CROSSED: &str =
    "its lower limit is not below its upper one, which MuJoCo refuses; it has no range";

/// The MJCF joints that together represent a URDF joint, in the order in which MuJoCo applies them.
fn joints_of(subject: &Subject, index: usize, notes: &mut Vec<Note>) -> Vec<Element> {
    match subject.view.joints[index].joint_type {
        JointType::Revolute | JointType::Continuous => vec![of_one(subject, index, "hinge", notes)],
        JointType::Prismatic => vec![of_one(subject, index, "slide", notes)],
        _ => subject.names.parts[index].iter().map(of_part).collect(),
    }
}

fn of_part((name, moves): &(String, Moves)) -> Element {
    let (kind, axis) = match moves {
        Moves::Slides(axis) => ("slide", Some(axis)),
        Moves::Turns(axis) => ("hinge", Some(axis)),
        Moves::Ball => ("ball", None),
    };
    Element::new("joint")
        .with("name", name.as_str())
        .with("type", kind)
        .with_some("axis", axis.map(|axis| numbers(axis.as_slice())))
}

fn of_one(subject: &Subject, index: usize, kind: &'static str, notes: &mut Vec<Note>) -> Element {
    let joint = &subject.view.joints[index];
    let mut element = Element::new("joint")
        .with("name", joint.name.as_str())
        .with("type", kind)
        .with("axis", numbers(&joint.axis));
    match joint.position_limits() {
        Some((lower, upper)) if lower < upper => {
            element = element.with("range", numbers(&[lower, upper]));
        }
        Some(_) if subject.locked_at(index).is_some() => {
            notes.push(Note::joint(&joint.name, LOCKED))
        }
        Some(_) => notes.push(Note::joint(&joint.name, CROSSED)),
        None => {}
    }
    let effort = positive(joint.limit.and_then(|limit| limit.effort));
    let dynamics = subject.urdf.joints[index].dynamics.as_ref();
    // The inertia of the motor, kg m² or kg.
    let armature = subject.gains(index).armature;
    element
        .with_some("actuatorfrcrange", effort.map(|effort| numbers(&[-effort, effort])))
        .with_some("damping", positive(dynamics.and_then(|d| d.damping)).map(number))
        .with_some("frictionloss", positive(dynamics.and_then(|d| d.friction)).map(number))
        .with_some("armature", armature.map(number))
}

fn words_of_mujoco(odd: Odd) -> &'static str {
    match odd {
        Odd::Negative => "its mass is negative, which MuJoCo takes for 0; so it is here",
        Odd::Indefinite => {
            "its inertia has a negative principal moment, which MuJoCo refuses; the mass stays, and the inertia is 0"
        }
        Odd::Triangle => {
            "a principal moment of inertia is more than the other two together, which MuJoCo refuses; MuJoCo takes their mean about each axis (balanceinertia)"
        }
    }
}

const NO_INERTIA: &str = "it moves, and MuJoCo refuses a moment of inertia of 0; the mass stays, and 1e-9 kg m² are assumed where it is less";
const NO_MASS: &str =
    "it moves without mass, which MuJoCo refuses; 1e-9 kg and 1e-9 kg m² are assumed";

/// The `inertial` element of each link, and whether MuJoCo has to balance moments.
fn inertials(subject: &Subject, notes: &mut Vec<Note>) -> (Vec<Option<Element>>, bool) {
    let mut balanced = false;
    let links = &subject.view.links;
    let mut note = |link: usize, what: &'static str| {
        notes.push(Note::Inertia { link: links[link].name.clone(), what });
    };
    let mut masses: Vec<Option<Mass>> = Vec::new();
    for (link, view) in links.iter().enumerate() {
        let (found, odd) = view.inertial.as_ref().map_or((None, None), mass);
        masses.push(found);
        balanced |= odd == Some(Odd::Triangle);
        if let Some(odd) = odd {
            note(link, words_of_mujoco(odd));
        }
    }
    for group in RigidGroups::new(&subject.view, &subject.tree).groups {
        if group.moved_by.is_none() && !subject.has_free_base() {
            continue;
        }
        let of_link = |link: &usize| masses[*link].as_ref();
        if group.links.iter().filter_map(of_link).any(Mass::is_enough) {
            continue;
        }
        let weight = |link: &usize| of_link(link).map_or(0.0, |mass| mass.mass);
        // The heaviest link, the first one on ties.
        let heavier = |a: &usize, b: &usize| weight(a).total_cmp(&weight(b)).then(b.cmp(a));
        let bodies = group.links.iter().filter(|link| !subject.is_frame(**link));
        let Some(&link) = bodies.max_by(|a, b| heavier(a, b)) else { continue };
        note(link, if weight(&link) > MIN_VALUE { NO_INERTIA } else { NO_MASS });
        masses[link].get_or_insert_default().raise();
    }
    let elements = masses.into_iter().map(|mass| mass.map(Mass::element));
    (elements.collect(), balanced)
}
