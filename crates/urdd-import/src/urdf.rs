//! Writes the URDF of a [`Model`], and what it cannot say into the files beside it: `NAME.srdf` for named configurations and
//! pairs that never collide, `NAME.export.toml` for what exports need, `NAME.loops.toml` for what closes chains.

use std::collections::{BTreeMap, HashMap, HashSet};

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use urdd_directory::account::{Account, AccountError};
use urdd_directory::export_toml::{ActuatorKind, File, JointGains, unplaced};
use urdd_directory::loops_toml::{self, CouplingTable, LoopTable};
use urdd_format::link_shapes_skips::SkipEdit;
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_kinematics::rotation::{from_rotation_vector, to_rpy};
use urdd_source::ImportOptions;
use urdd_source::loops::table;
use urdd_srdf::write;
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;

use crate::model::{Geometry, Inertial, Joint, JointKind, Material, Model, Shape, Use};
use crate::place::{Fallible, Place, Placing};
use crate::tree::{Edge, Link, Titles, Tree};

/// The limits of a slide that has none, m.
const FAR: f64 = 10.0;
/// What a joint can do, of which it is not said: N, N m, m/s or rad/s.
const MUCH: f64 = 1000.0;
/// The mass and the moments of a link between the joints of a body, kg and kg m²: what exports to MJCF assume, too.
const TINY: f64 = 1e-9;
/// The file of the mesh that ellipsoids are made of: a sphere of radius 1.
pub const UNIT_SPHERE: &str = "meshes/unit_sphere.obj";

/// The text of the URDF.
///
/// # Errors
/// If the account does not have what names cost that are made of others; with the place of the body.
pub fn urdf(
    model: &Model,
    tree: &Tree,
    original: &str,
    options: &ImportOptions,
    account: &Account,
) -> Fallible<String> {
    let mut titles = Titles::new(account);
    let mut robot = Element::new("robot").with("name", &*model.name);
    let start = Place::default();
    let mut edges = tree.joints.walk(account).at(start)?;
    for link in tree.links.walk(account).at(start)? {
        let element = link_element(model, link, options, &mut titles, account);
        robot.push(element.at(link.place)?);
        // Each link but the root follows the joint that leads to it.
        if link.name == tree.links[0].name {
            continue;
        }
        if let Some(edge) = edges.next() {
            robot.push(joint_element(model, edge));
        }
    }
    robot.extend(edges.map(|edge| joint_element(model, edge)));
    for element in model.elements.walk(account).at(start)? {
        robot.push_raw(&element.0);
    }
    Ok(robot.document(&[format!("`urdd import` made this file from {original}.")]))
}

fn link_element(
    model: &Model,
    link: &Link,
    options: &ImportOptions,
    titles: &mut Titles,
    account: &Account,
) -> Result<Element, AccountError> {
    let mut element = Element::new("link").with("name", &*link.name);
    let Some(body) = link.body.map(|body| &model.bodies[body]) else {
        let tiny = Inertial::along_axes(TINY, [TINY; 3]);
        element.extend(options.has_tiny_masses.then(|| inertial(&tiny)));
        return Ok(element);
    };
    element.extend(body.inertial.as_ref().map(inertial));
    for (name, is_wanted) in
        [("visual", [Use::Visual, Use::Both]), ("collision", [Use::Collision, Use::Both])]
    {
        let shapes = body.shapes.walk(account)?.filter(|shape| is_wanted.contains(&shape.used));
        for shape in shapes {
            let title = shape.name.as_ref();
            let title = title.map(|title| titles.shape(name == "visual", &link.name, title));
            let title = title.transpose()?;
            for (suffix, pose, geometry) in parts(shape) {
                let title = title.as_ref().map(|title| format!("{title}{suffix}"));
                let mut part = Element::new(name).with_some("name", title);
                part.extend(origin(&pose));
                part.push(Element::new("geometry").holding(shape_element(model, &geometry)));
                if let Some(of) = shape.material.as_ref().filter(|_| name == "visual") {
                    part.push(material(model, of, titles.material(model, of)?));
                }
                element.push(part);
            }
        }
    }
    Ok(element)
}

/// A shape as shapes of URDF 1.0, each with what is put behind its name.
fn parts(shape: &Shape) -> Vec<(&'static str, Isometry3<f64>, Geometry)> {
    let Geometry::Capsule { radius, length } = shape.geometry else {
        return vec![("", shape.pose, shape.geometry.clone())];
    };
    let end = |z: f64| shape.pose * Translation3::new(0.0, 0.0, z);
    vec![
        ("", shape.pose, Geometry::Cylinder { radius, length }),
        ("_top", end(length / 2.0), Geometry::Sphere(radius)),
        ("_bottom", end(-length / 2.0), Geometry::Sphere(radius)),
    ]
}

fn shape_element(model: &Model, geometry: &Geometry) -> Element {
    let mesh = |file: &str, scale: [f64; 3]| {
        let scale = (scale != [1.0; 3]).then(|| numbers(&scale));
        Element::new("mesh").with("filename", file).with_some("scale", scale)
    };
    match geometry {
        Geometry::Box(size) => Element::new("box").with("size", numbers(size)),
        Geometry::Cylinder { radius, length } | Geometry::Capsule { radius, length } => {
            let sizes = [("radius", Some(*radius)), ("length", Some(*length))];
            Element::new("cylinder").with_numbers(sizes)
        }
        Geometry::Sphere(radius) => {
            Element::new("sphere").with_numbers([("radius", Some(*radius))])
        }
        Geometry::Ellipsoid(radii) => mesh(UNIT_SPHERE, *radii),
        Geometry::Mesh { asset, scale } => {
            mesh(model.assets.get(*asset).map_or("", |asset| &asset.path), *scale)
        }
    }
}

fn material(model: &Model, material: &Material, name: String) -> Element {
    let mut element = Element::new("material").with("name", name);
    let rgba = material.rgba.map(|rgba| Element::new("color").with("rgba", numbers(&rgba)));
    element.extend(rgba);
    let texture = material.texture.and_then(|texture| model.assets.get(texture));
    element.extend(texture.map(|file| Element::new("texture").with("filename", &*file.path)));
    element
}

fn inertial(of: &Inertial) -> Element {
    let mut element = Element::new("inertial");
    element.extend(origin(&Translation3::from(of.centre.coords).into()));
    element.push(Element::new("mass").with_numbers([("value", Some(of.mass))]));
    let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
    let places = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
    let values = names.into_iter().zip(places.map(|place| Some(of.inertia[place])));
    element.push(Element::new("inertia").with_numbers(values));
    element
}

fn joint_element(model: &Model, edge: &Edge) -> Element {
    let mut element = Element::new("joint").with("name", &*edge.name).with("type", edge.kind);
    element.extend(origin(&edge.origin));
    element.push(Element::new("parent").with("link", &*edge.parent));
    element.push(Element::new("child").with("link", &*edge.child));
    let axis = edge.axis.and_then(|axis| axis.try_normalize(0.0));
    element.extend(axis.map(|axis| Element::new("axis").with("xyz", numbers(axis.as_slice()))));
    let Some((body, joint)) = edge.joint else {
        return element;
    };
    let joint = &model.bodies[body].joints[joint];
    if joint.kind != JointKind::Floating && edge.kind != "spherical" {
        let range = edge.range.or((edge.kind == "prismatic").then_some([-FAR, FAR]));
        let [lower, upper] = match range {
            Some([lower, upper]) => [Some(lower), Some(upper)],
            None => [None, None],
        };
        let [effort, velocity] = [joint.effort, joint.velocity].map(|of| of.or(Some(MUCH)));
        element.push(Element::new("limit").with_numbers([
            ("lower", lower),
            ("upper", upper),
            ("effort", effort),
            ("velocity", velocity),
        ]));
    }
    let [damping, friction] = [joint.damping, joint.friction];
    if damping != 0.0 || friction != 0.0 {
        element.push(
            Element::new("dynamics")
                .with_numbers([("damping", Some(damping)), ("friction", Some(friction))]),
        );
    }
    element.extend(edge.mimic.as_ref().map(|mimic| {
        Element::new("mimic")
            .with("joint", &*mimic.joint)
            .with_numbers([("multiplier", Some(mimic.multiplier)), ("offset", Some(mimic.offset))])
    }));
    element
}

fn origin(pose: &Isometry3<f64>) -> Option<Element> {
    let xyz = pose.translation.vector;
    let rpy = to_rpy(pose.rotation.to_rotation_matrix().matrix());
    let xyz = (xyz.amax() != 0.0).then(|| numbers(xyz.as_slice()));
    let rpy = (rpy != [0.0; 3]).then(|| numbers(&rpy));
    (xyz.is_some() || rpy.is_some())
        .then(|| Element::new("origin").with_some("xyz", xyz).with_some("rpy", rpy))
}

/// The group whose states are the named configurations.
const GROUP: &str = "all";

/// The joints of the URDF that are DOFs: each with the values that it has in the configurations.
fn movable<'t>(
    tree: &'t Tree,
    account: &Account,
) -> Result<impl Iterator<Item = &'t Edge>, AccountError> {
    let all = tree.joints.walk(account)?;
    Ok(all.filter(|edge| edge.joint.is_some() && edge.mimic.is_none()))
}

/// The values of a joint of the URDF, with what its DOFs add to its name.
type JointValues<'t> = (&'t str, Vec<f64>, &'static [&'static str]);

/// The values of the joints of the URDF in a configuration.
fn values<'t>(
    model: &Model,
    tree: &'t Tree,
    at: usize,
    account: &Account,
) -> Result<Vec<JointValues<'t>>, AccountError> {
    let configuration = &model.configurations[at].values;
    let by_joint: HashMap<(usize, usize), &[f64]> =
        configuration.walk(account)?.map(|value| (value.joint, &*value.values)).collect();
    let mut turns: HashMap<(usize, usize), usize> = HashMap::new();
    let mut all = Vec::new();
    for edge in movable(tree, account)? {
        let Some((body, place)) = edge.joint else { continue };
        let joint = &model.bodies[body].joints[place];
        let Some(values) = by_joint.get(&(body, place)) else { continue };
        let is_split = joint.kind == JointKind::Ball && edge.kind != "spherical";
        let (own, dofs) = match (is_split, values) {
            (true, [x, y, z]) => {
                let turn = turns.entry((body, place)).or_default();
                let angles = in_turn([*x, *y, *z]);
                *turn += 1;
                (vec![angles[(*turn - 1).min(2)]], JointKind::Hinge.dofs())
            }
            _ => (values.to_vec(), joint.kind.dofs()),
        };
        all.push((&*edge.name, own, dofs));
    }
    Ok(all)
}

/// The angles about x, then y, then z as they are turned, of a rotation vector.
fn in_turn(vector: [f64; 3]) -> [f64; 3] {
    let rotation: UnitQuaternion<f64> = from_rotation_vector(vector);
    // The inverse turns about z, then y, then x, as fixed axes do from behind: roll, pitch and yaw, negated.
    let columns = rotation.inverse().to_rotation_matrix();
    let [roll, pitch, yaw] = urdd_kinematics::rotation::to_rpy(columns.matrix());
    Vector3::new(-roll, -pitch, -yaw).into()
}

/// The named configurations, as a URDD has them.
pub fn configurations(
    model: &Model,
    tree: &Tree,
    account: &Account,
) -> Result<Vec<ConfigurationEdit>, AccountError> {
    let mut all = Vec::new();
    for (at, configuration) in model.configurations.walk(account)?.enumerate() {
        let Some(name) = ConfigurationName::new(&configuration.name) else { continue };
        let positions = values(model, tree, at, account)?.into_iter();
        let positions = positions.flat_map(|(joint, values, dofs)| {
            let names = dofs.iter().map(move |dof| format!("{joint}{dof}"));
            names.zip(values).map(|(dof_name, position)| DofPosition { dof_name, position })
        });
        all.push(ConfigurationEdit { name, positions: positions.collect() });
    }
    Ok(all)
}

/// The pairs that are never checked, and those that are, as a URDD has them. That of neighbours needs no edit.
pub fn skips(model: &Model, account: &Account) -> Result<Vec<SkipEdit>, AccountError> {
    let apart = model.apart.walk(account)?.filter(|apart| apart.reason != "Adjacent");
    let apart = apart.map(|apart| (apart, true));
    let checked = model.checked.walk(account)?.map(|pair| (pair, false));
    let edit = apart.chain(checked).map(|(pair, skip)| {
        let [link_a, link_b] = pair.bodies.map(|body| model.bodies[body].name.clone());
        SkipEdit { link_a, link_b, skip, reason: format!("imported: {}", pair.reason) }
    });
    Ok(edit.collect())
}

/// The text of `NAME.srdf`; none where it would say nothing.
pub fn srdf(
    model: &Model,
    tree: &Tree,
    original: &str,
    account: &Account,
) -> Result<Option<String>, AccountError> {
    if model.configurations.is_empty() && model.apart.is_empty() {
        return Ok(None);
    }
    let mut robot = Element::new("robot").with("name", &*model.name);
    if !model.configurations.is_empty() {
        let mut group = write::group(GROUP);
        group.extend(movable(tree, account)?.map(|edge| write::joint(&edge.name)));
        robot.push(group);
    }
    for (at, configuration) in model.configurations.walk(account)?.enumerate() {
        let values = values(model, tree, at, account)?.into_iter();
        let values = values.map(|(joint, values, _)| (joint, numbers(&values)));
        robot.push(write::state(&configuration.name, GROUP, values));
    }
    for apart in model.apart.walk(account)? {
        let links = apart.bodies.map(|body| &*model.bodies[body].name);
        robot.push(write::disabled(links, apart.reason));
    }
    Ok(Some(robot.document(&[format!("`urdd import` made this file from {original}.")])))
}

/// The text of `NAME.loops.toml`; none where it would say nothing.
pub fn loops(model: &Model, account: &Account) -> Result<Option<String>, AccountError> {
    let mut file = loops_toml::File::default();
    let mut names = HashSet::new();
    // Of a name that is taken, the number that is tried next.
    let mut next: HashMap<String, usize> = HashMap::new();
    let mut named = |name: &Option<String>, kind: &str, place: usize| {
        let base = name.clone().unwrap_or_else(|| format!("{kind}{}", place + 1));
        let mut free = base.clone();
        while !names.insert(free.clone()) {
            let number = next.entry(base.clone()).or_insert(1);
            *number += 1;
            free = format!("{base}_{number}");
        }
        free
    };
    for (place, closing) in model.closings.walk(account)?.enumerate() {
        let [a, b] = &closing.ends;
        file.loops.push(unplaced(LoopTable {
            name: named(&closing.name, "loop_", place),
            kind: closing.kind,
            link_a: unplaced(model.bodies[a.body].name.clone()),
            frame_a: table(&a.frame),
            link_b: unplaced(model.bodies[b.body].name.clone()),
            frame_b: table(&b.frame),
        }));
    }
    for (place, coupled) in model.couplings.walk(account)?.enumerate() {
        let mut terms = BTreeMap::new();
        for (joint, coefficients) in &coupled.terms {
            terms.insert(unplaced(joint.as_str().into()), coefficients.as_slice().into());
        }
        let name = named(&coupled.name, "coupling_", place);
        file.couplings.push(unplaced(CouplingTable { name, constant: coupled.constant, terms }));
    }
    if file.is_empty() {
        return Ok(None);
    }
    let head = "# `urdd import` made this file: what closes the chains of the robot; `urdd generate` reads it.\n";
    Ok(file.to_text().ok().map(|text| head.to_owned() + &text))
}

/// The text of `NAME.export.toml`; none where it would say nothing.
pub fn setup(
    model: &Model,
    tree: &Tree,
    account: &Account,
) -> Result<Option<String>, AccountError> {
    let mut file = File::of(&model.name);
    // Nothing drives a joint that follows another.
    for edge in movable(tree, account)? {
        let Some((body, place)) = edge.joint else { continue };
        let gains = gains(&model.bodies[body].joints[place]);
        if gains != JointGains::default() {
            file.actuators.joint.insert(unplaced(edge.name.clone()), unplaced(gains));
        }
    }
    if file.actuators.joint.is_empty() && !model.is_floating && model.friction.is_none() {
        return Ok(None);
    }
    if model.is_floating {
        file.base.floating = true;
        let named = model.configurations.walk(account)?;
        let named = named.filter(|of| ConfigurationName::new(&of.name).is_some());
        let poses =
            named.filter_map(|of| Some((unplaced(of.name.clone()), unplaced(of.base?.to_vec()))));
        file.base.poses = poses.collect();
    }
    file.contact.friction = model.friction.map(unplaced);
    let head = "# `urdd import` made this file; `urdd export --setup` reads it.\n";
    Ok(file.to_text().ok().map(|text| head.to_owned() + &text))
}

/// What exports read of the actuator of a joint.
fn gains(joint: &Joint) -> JointGains {
    let actuator = &joint.actuator;
    JointGains {
        name: actuator.name.clone(),
        kind: actuator.is_of_speed.then_some(ActuatorKind::Velocity),
        kp: joint.kp,
        kv: joint.kv,
        armature: joint.armature,
        ctrlrange: actuator.control,
        // A force that is as great either way is the effort of the URDF.
        forcerange: actuator.force.filter(|[least, most]| *least != -*most),
    }
}
