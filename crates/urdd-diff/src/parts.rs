//! Differences of links, joints and materials: mass properties, geometry, values.

use std::collections::{HashMap, HashSet, VecDeque};

use urdd_document::pose::unit;
use urdd_format::diff_report::{DiffBox, GeometryDifference, LinkDifference, ValueChange};
use urdd_format::meshes::GeometryKind;
use urdd_format::urdf::{Capsule, Cylinder, Geometry, Joint, JointType, Limit, Link, Material};
use urdd_geometry::mesh::Bounds;
use urdd_xml::other_parts::{OtherParts, Owner};

use crate::beyond_urdf;
use crate::fields::{Fields, Parts, compare, matched, numbers};
use crate::shapes::mesh_at;
use crate::side::Side;

pub fn links(before: &Side, after: &Side, tolerance: f64) -> Vec<LinkDifference> {
    let (a, b) = (before.link_names(), after.link_names());
    let by_name = compared_by_name(before, after);
    let mut found = Vec::new();
    for part in matched(&a, &b) {
        let (mut changes, mut geometry) = (Vec::new(), Vec::new());
        if let Some((i, j)) = part.both() {
            let others = before.others_beside(after);
            let [x, y] =
                [(before, i, others[0]), (after, j, others[1])].map(|(side, link, others)| {
                    let link = &side.robot.links[link];
                    let mut fields = link_fields(link, side.has_quaternions());
                    beyond_urdf::add(&link.unknown_elements, &side.account, &mut fields);
                    let owner = Owner::Link(link.name.clone());
                    beyond_urdf::add_parts(others, &owner, &[], &mut fields);
                    fields
                });
            changes = compare("", &x, &y, tolerance);
            for kind in [GeometryKind::Visual, GeometryKind::Collision] {
                let (x, y) = ((before, i), (after, j));
                geometry.extend(geometry_of(x, y, kind, &by_name, tolerance));
            }
            if changes.is_empty() && geometry.is_empty() {
                continue;
            }
        }
        let (name, presence) = (part.name.to_owned(), part.presence());
        found.push(LinkDifference { name, presence, changes, geometry });
    }
    found
}

/// All values of a link but those of its geometry.
fn link_fields(link: &Link, quaternions: bool) -> Fields {
    let mut fields = Fields::default();
    if let Some(inertial) = &link.inertial {
        let mass = inertial.mass.as_ref().map(|mass| mass.value);
        fields.number("inertial.mass", "kg", mass);
        let origin = inertial.origin.as_ref();
        if mass.is_some() || inertial.inertia.is_some() || origin.is_some() {
            fields.origin("inertial.origin.", origin, quaternions);
        }
        if let Some(of) = &inertial.inertia {
            for (name, value) in [
                ("ixx", of.ixx),
                ("ixy", of.ixy),
                ("ixz", of.ixz),
                ("iyy", of.iyy),
                ("iyz", of.iyz),
                ("izz", of.izz),
            ] {
                fields.number(format!("inertial.{name}"), "kg m²", value);
            }
        }
    }
    fields
}

/// `said` are names of attributes that another list compares.
pub fn joints(side: &Side, others: Option<&OtherParts>, said: &[&str]) -> Parts {
    let part = |joint: &Joint| {
        let mut fields = joint_fields(joint, side.has_quaternions());
        beyond_urdf::add(&joint.unknown_elements, &side.account, &mut fields);
        let owner = Owner::Joint(joint.name.clone());
        beyond_urdf::add_parts(others, &owner, said, &mut fields);
        (joint.name.clone(), fields)
    };
    side.robot.joints.iter().map(part).collect()
}

/// All values of a joint, with the defaults of SPEC 5.7, 5.10 and 6.1.8 in place of what is absent.
fn joint_fields(joint: &Joint, quaternions: bool) -> Fields {
    let mut fields = Fields::default();
    fields.text("type", Some(joint.joint_type.as_str()));
    fields.text("parent", Some(&joint.parent.link));
    fields.text("child", Some(&joint.child.link));
    fields.origin("origin.", joint.origin.as_ref(), quaternions);
    if has_axis(joint.joint_type) {
        let axis = joint.axis.as_ref().and_then(|axis| axis.xyz).unwrap_or([1.0, 0.0, 0.0]);
        // Only the direction has a meaning.
        let direction = unit(axis).map_or(axis, Into::into);
        fields.keyed("axis", numbers(&direction), numbers(&axis));
    }
    if let Some(limit) = &joint.limit {
        add_limit(limit, joint.joint_type, &mut fields);
    }
    let dynamics = joint.dynamics.as_ref();
    let [position, _, _, damping, friction] = units(joint.joint_type);
    let value = dynamics.and_then(|dynamics| dynamics.damping);
    fields.number("dynamics.damping", damping, Some(value.unwrap_or(0.0)));
    let value = dynamics.and_then(|dynamics| dynamics.friction);
    fields.number("dynamics.friction", friction, Some(value.unwrap_or(0.0)));
    if let Some(mimic) = &joint.mimic {
        fields.text("mimic.joint", Some(&mimic.joint));
        fields.number("mimic.multiplier", "", Some(mimic.multiplier.unwrap_or(1.0)));
        fields.number("mimic.offset", position, Some(mimic.offset.unwrap_or(0.0)));
    }
    if let Some(safety) = &joint.safety_controller {
        for (name, unit, value) in [
            ("soft_lower_limit", position, safety.soft_lower_limit),
            ("soft_upper_limit", position, safety.soft_upper_limit),
            ("k_position", "", safety.k_position),
            ("k_velocity", "", safety.k_velocity),
        ] {
            fields.number(format!("safety_controller.{name}"), unit, value);
        }
    }
    if let Some(calibration) = &joint.calibration {
        fields.number("calibration.rising", position, calibration.rising);
        fields.number("calibration.falling", position, calibration.falling);
    }
    fields
}

/// Whether the axis of a joint has a meaning (SPEC 6.3.4).
fn has_axis(joint_type: JointType) -> bool {
    use JointType::{Continuous, Planar, Prismatic, Revolute};
    matches!(joint_type, Revolute | Continuous | Prismatic | Planar)
}

fn add_limit(limit: &Limit, joint_type: JointType, fields: &mut Fields) {
    let [position, speed, effort, ..] = units(joint_type);
    let (acceleration, jerk) = match joint_type {
        JointType::Prismatic => ("m/s²", "m/s³"),
        _ => ("rad/s²", "rad/s³"),
    };
    // Of the two, one that is absent is 0 (SPEC 6.5.2).
    let lower = limit.lower.or(limit.upper.map(|_| 0.0));
    let upper = limit.upper.or(limit.lower.map(|_| 0.0));
    for (name, unit, value) in [
        ("lower", position, lower),
        ("upper", position, upper),
        ("effort", effort, limit.effort),
        ("velocity", speed, limit.velocity),
        ("acceleration", acceleration, limit.acceleration),
        ("deceleration", acceleration, limit.deceleration),
        ("jerk", jerk, limit.jerk),
    ] {
        fields.number(format!("limit.{name}"), unit, value);
    }
}

/// Units of position, speed, effort, damping and friction.
fn units(joint_type: JointType) -> [&'static str; 5] {
    match joint_type {
        JointType::Prismatic => ["m", "m/s", "N", "N s/m", "N"],
        _ => ["rad", "rad/s", "N m", "N m s/rad", "N m"],
    }
}

/// Mesh file names that at least one of the robots has no content for: elements with these are compared by name.
fn compared_by_name<'a>(before: &'a Side, after: &'a Side) -> HashSet<&'a str> {
    let unread = |side: &'a Side| {
        let unread = side.shapes.meshes.iter().filter(|(_, mesh)| mesh.is_err());
        unread.filter_map(|(place, _)| Some(mesh_at(&side.view, *place)?.1.filename.as_str()))
    };
    unread(before).chain(unread(after)).collect()
}

struct Element {
    name: Option<String>,
    shape: Fields,
    /// The material as written, and with what it takes from the top of the URDF.
    material: [Fields; 2],
}

impl Element {
    fn key(&self) -> String {
        format!("{}|{}", self.shape.key(), self.material[0].key())
    }

    /// The values that differ. Where both name the same material, a difference is that of the material.
    fn changes(&self, prefix: &str, other: &Element, tolerance: f64) -> Vec<ValueChange> {
        let mut changes = compare(prefix, &self.shape, &other.shape, tolerance);
        if self.material[0].key() != other.material[0].key() {
            let [a, b] = [self, other].map(|element| &element.material[1]);
            changes.extend(compare(prefix, a, b, tolerance));
        }
        changes
    }
}

/// How the geometry of one kind of a link differs; `None` if it does not.
fn geometry_of(
    before: (&Side, usize),
    after: (&Side, usize),
    kind: GeometryKind,
    by_name: &HashSet<&str>,
    tolerance: f64,
) -> Option<GeometryDifference> {
    let [a, b] = [before, after].map(|(side, link)| of_link(side, link, kind, by_name));
    let changes = changes(&a, &b, kind, tolerance);
    if changes.is_empty() {
        return None;
    }
    let bounds = |(side, link): (&Side, usize)| {
        let bounds = side.shapes.bounds(&side.view, link, kind);
        bounds.map(|Bounds { min, max }| DiffBox { min, max })
    };
    Some(GeometryDifference {
        geometry: kind,
        changes,
        bounds_before: bounds(before),
        bounds_after: bounds(after),
    })
}

/// Matches the elements of a link: those that are equal, in whatever order, then those with the same name, then the
/// others in order.
fn changes(
    before: &[Element],
    after: &[Element],
    kind: GeometryKind,
    tolerance: f64,
) -> Vec<ValueChange> {
    let mut partner: Vec<Option<usize>> = vec![None; before.len()];
    let mut taken = vec![false; after.len()];
    let steps: [fn(&Element) -> Option<String>; 3] =
        [|element| Some(element.key()), |element| element.name.clone(), |_| Some(String::new())];
    for key in steps {
        let mut free: HashMap<String, VecDeque<usize>> = HashMap::new();
        for (j, element) in after.iter().enumerate().filter(|(j, _)| !taken[*j]) {
            if let Some(key) = key(element) {
                free.entry(key).or_default().push_back(j);
            }
        }
        for (i, element) in before.iter().enumerate() {
            if partner[i].is_none()
                && let Some(key) = key(element)
                && let Some(j) = free.get_mut(&key).and_then(VecDeque::pop_front)
            {
                (partner[i], taken[j]) = (Some(j), true);
            }
        }
    }
    let word = kind.as_str().to_lowercase();
    let whole = |index: usize, before: Option<&Element>, after: Option<&Element>| {
        let summary = |element: &Element| {
            let parts = [&element.shape, &element.material[1]].map(Fields::summary);
            let parts = parts.into_iter().filter(|part| !part.is_empty());
            parts.collect::<Vec<_>>().join(", ")
        };
        ValueChange {
            field: format!("{word}[{index}]"),
            before: before.map(summary),
            after: after.map(summary),
            unit: String::new(),
        }
    };
    let mut changes = Vec::new();
    for (i, element) in before.iter().enumerate() {
        match partner[i] {
            Some(j) => {
                let prefix = format!("{word}[{i}].");
                changes.extend(element.changes(&prefix, &after[j], tolerance));
            }
            None => changes.push(whole(i, Some(element), None)),
        }
    }
    let new = after.iter().enumerate().filter(|(j, _)| !taken[*j]);
    changes.extend(new.map(|(j, element)| whole(j, None, Some(element))));
    changes
}

fn of_link(side: &Side, link: usize, kind: GeometryKind, by_name: &HashSet<&str>) -> Vec<Element> {
    let of = &side.robot.links[link];
    let element = |index, name: &Option<String>, origin, geometry: &Option<Geometry>, material| {
        let mut shape = Fields::default();
        shape.text("name", name.as_deref());
        if let Some(geometry) = geometry {
            add_shape(geometry, &mut shape, |filename| {
                let mesh = side.shapes.meshes.get(&(link, kind, index));
                match mesh {
                    Some(Ok(mesh)) if !by_name.contains(filename) => {
                        let short = mesh.fingerprint.get(..12).unwrap_or_default();
                        let shown = format!("{} triangles ({short})", mesh.count);
                        (mesh.fingerprint.clone(), shown)
                    }
                    _ => (format!("file {filename}"), format!("file `{filename}`")),
                }
            });
        }
        shape.origin("origin.", origin, side.has_quaternions());
        let material = [&[], &side.robot.materials[..]].map(|tops| resolved(material, tops));
        Element { name: name.clone(), shape, material }
    };
    match kind {
        GeometryKind::Visual => {
            let visuals = of.visual.iter().enumerate().map(|(index, of)| {
                element(index, &of.name, of.origin.as_ref(), &of.geometry, of.material.as_ref())
            });
            visuals.collect()
        }
        GeometryKind::Collision => {
            let collisions = of.collision.iter().enumerate().map(|(index, of)| {
                element(index, &of.name, of.origin.as_ref(), &of.geometry, None)
            });
            collisions.collect()
        }
    }
}

/// Adds the values of a shape. `mesh` says by what a mesh with a file name is compared, and how it is shown.
fn add_shape(geometry: &Geometry, fields: &mut Fields, mesh: impl Fn(&str) -> (String, String)) {
    let kind = match geometry {
        Geometry::Mesh(_) => "mesh",
        Geometry::Box(_) => "box",
        Geometry::Cylinder(_) => "cylinder",
        Geometry::Capsule(_) => "capsule",
        Geometry::Sphere(_) => "sphere",
    };
    fields.text("shape", Some(kind));
    match geometry {
        Geometry::Mesh(of) => {
            let (key, shown) = mesh(&of.filename);
            fields.keyed("mesh", key, shown);
            fields.numbers("scale", "", Some(of.scale.unwrap_or([1.0; 3])));
        }
        Geometry::Box(of) => fields.numbers("size", "m", Some(of.size)),
        Geometry::Cylinder(Cylinder { radius, length })
        | Geometry::Capsule(Capsule { radius, length }) => {
            fields.number("radius", "m", Some(*radius));
            fields.number("length", "m", Some(*length));
        }
        Geometry::Sphere(of) => fields.number("radius", "m", Some(of.radius)),
    }
}

/// The materials at the top of a URDF as parts.
pub fn materials(materials: &[Material]) -> Parts {
    let part = |material: &Material| {
        let mut fields = Fields::default();
        add_look("", material, &mut fields);
        (material.name.clone().unwrap_or_default(), fields)
    };
    materials.iter().map(part).collect()
}

/// The values of a visual element's material. A colour and a texture that it does not state are those of the first
/// material at the top of the URDF that has this name and states one.
fn resolved(material: Option<&Material>, tops: &[Material]) -> Fields {
    let mut fields = Fields::default();
    let Some(material) = material else { return fields };
    let named = |top: &&Material| top.name.is_some() && top.name == material.name;
    let tops = || tops.iter().filter(named);
    let look = Material {
        name: material.name.clone(),
        color: (material.color.clone()).or_else(|| tops().find_map(|top| top.color.clone())),
        texture: (material.texture.clone()).or_else(|| tops().find_map(|top| top.texture.clone())),
    };
    // Published URDDs have an empty name where there is none.
    let name = look.name.as_deref().filter(|name| !name.is_empty());
    fields.text("material.name", name);
    add_look("material.", &look, &mut fields);
    fields
}

fn add_look(prefix: &str, material: &Material, fields: &mut Fields) {
    let rgba = material.color.as_ref().map(|color| color.rgba);
    fields.numbers(format!("{prefix}rgba"), "", rgba);
    let texture = material.texture.as_ref().map(|texture| texture.filename.as_str());
    fields.text(format!("{prefix}texture"), texture);
}
