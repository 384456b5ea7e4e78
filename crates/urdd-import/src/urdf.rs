//! Writes the URDF of a [`Model`].

use nalgebra::{Isometry3, Translation3};

use super::model::{Geometry, Inertial, JointKind, Material, Model, Shape, Use};
use super::names::Titles;
use super::refusal::{Fallible, Placing};
use super::tree::{Edge, Link, Tree};
use urdd_directory::account::{Account, Overdrawn};
use urdd_kinematics::rotation::to_rpy;
use urdd_source::ImportOptions;
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;

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
    let mut edges = tree.joints.iter();
    for link in &tree.links {
        robot.push(link_element(model, link, options, &mut titles).at(link.place)?);
        // Each link but the root follows the joint that leads to it.
        if link.name == tree.links[0].name {
            continue;
        }
        if let Some(edge) = edges.next() {
            robot.push(joint_element(model, edge));
        }
    }
    robot.extend(edges.map(|edge| joint_element(model, edge)));
    for element in &model.elements {
        robot.push_raw(&element.0);
    }
    Ok(robot.document(&[format!("`urdd import` made this file from {original}.")]))
}

fn link_element(
    model: &Model,
    link: &Link,
    options: &ImportOptions,
    titles: &mut Titles,
) -> Result<Element, Overdrawn> {
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
        let shapes = body.shapes.iter().filter(|shape| is_wanted.contains(&shape.used));
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
