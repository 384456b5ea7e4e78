//! Reads links: their masses, and visual and collision shapes.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Matrix3, Point3, Translation3, Vector3};
use urdd_geometry::read::Part;
use urdd_geometry::write::stl;

use super::libsdformat::{REFUSED, takes_mass};
use super::reader::{SdfReader, keep};
use super::scene::{Link, Node, NodeKind, Placeable, WORLD};
use super::tag::Tag;
use crate::fault::{ImportFault, SdfFault, Unreachable};
use crate::features::{self, Tally};
use crate::graph::cone;
use crate::mass::{WATER, turned};
use crate::model::{Geometry, Inertial, Material, Shape, Use};
use crate::place::{Fallible, Placing, at};

/// What Gazebo alone reads of a link, and is kept as text.
const KEPT: &[&str] = &[
    "sensor",
    "plugin",
    "gravity",
    "enable_wind",
    "self_collide",
    "kinematic",
    "must_be_base_link",
    "velocity_decay",
    "projector",
    "audio_sink",
    "audio_source",
    "battery",
    "light",
    "particle_emitter",
];

pub fn link(reader: &mut SdfReader, tag: Tag, scope: usize) -> Fallible<()> {
    let name = tag.own_name()?;
    if name == WORLD {
        return Err(at(tag.place(), SdfFault::WorldLink(name)));
    }
    let whole = reader.whole_name(tag, scope, &name)?;
    let kind = NodeKind::Link(reader.scene.links.len());
    let node = Node::of(tag, whole.clone(), kind, scope)?;
    let index = reader.scene.nodes.len();
    if !reader.scene.add(scope, &name, node) {
        return Err(at(tag.place(), SdfFault::Twice { kind: "link", name }));
    }
    reader.tally.count(features::BODIES);
    let mut shapes = Vec::new();
    for child in tag.children() {
        match child.name() {
            "pose" | "inertial" => {}
            "visual" | "collision" => shapes.extend(shape(reader, child)?),
            name if KEPT.contains(&name) => keep(reader, child, Some((&whole, index)))?,
            name => reader.tally.unread(format!("`<{name}>` of `<link>`")),
        }
    }
    let inertial = inertial(tag, &mut reader.tally)?;
    reader.scene.links.push(Link { node: index, inertial, shapes });
    Ok(())
}

/// The places of an inertia, by name.
const PLACES: [(&str, usize, usize); 6] =
    [("ixx", 0, 0), ("ixy", 0, 1), ("ixz", 0, 2), ("iyy", 1, 1), ("iyz", 1, 2), ("izz", 2, 2)];

/// Reads the mass of a link. What it does not say is 1 kg and 1 kg m², as SDF has it.
pub fn inertial(link: Tag, tally: &mut Tally) -> Fallible<Inertial> {
    let Some(tag) = link.child("inertial") else {
        tally.count(features::DEFAULT_MASSES);
        return Ok(Inertial::along_axes(1.0, [1.0; 3]));
    };
    let known = ["pose", "mass", "inertia", "density", "auto_inertia_params"];
    tag.unread(&known, tally);
    if tag.says("auto") {
        if let Some(inertial) = auto_inertia(link, tag, tally)? {
            tally.count(features::AUTO_MASSES);
            return Ok(inertial);
        }
        let text =
            "the mass follows from shapes, and no shape here gives one: it is read as it is given";
        tally.remark(tag.place(), text);
    }
    let (pose, _) = tag.pose()?;
    let mass = tag.number("mass")?;
    let mut own = Matrix3::identity();
    let mut is_given = mass.is_some();
    if let Some(inertia) = tag.child("inertia") {
        for (name, row, column) in PLACES {
            let value = inertia.number(name)?;
            is_given &= value.is_some() || row != column;
            if let Some(value) = value {
                own[(row, column)] = value;
                own[(column, row)] = value;
            }
        }
    } else {
        is_given = false;
    }
    if !takes_mass(mass.unwrap_or(1.0), &own) {
        let text = format!("{REFUSED}no body has such a mass and such moments of inertia");
        tally.remark(tag.place(), text);
    }
    tally.count(if is_given { features::MASSES } else { features::DEFAULT_MASSES });
    Ok(placed(mass.unwrap_or(1.0), &own, &pose))
}

/// A mass whose inertia is along the axes of its own frame.
fn placed(mass: f64, own: &Matrix3<f64>, pose: &Isometry3<f64>) -> Inertial {
    let inertia = if pose.rotation.angle() == 0.0 {
        *own
    } else {
        let turned = turned(own, &pose.rotation);
        (turned + turned.transpose()) / 2.0
    };
    Inertial { mass, centre: pose.translation.vector.into(), inertia }
}

/// The mass of the collision shapes of a link; `None` without shapes that have one. A mass that is given scales it.
fn auto_inertia(link: Tag, tag: Tag, tally: &mut Tally) -> Fallible<Option<Inertial>> {
    let density = tag.number("density")?.unwrap_or(WATER);
    let mut parts = Vec::new();
    for collision in link.children().filter(|child| child.name() == "collision") {
        let Some(geometry) = collision.child("geometry") else { continue };
        let Some(shape) = geometry.children().next() else { continue };
        let own = collision.number("density")?.unwrap_or(density);
        let Some(part) = part(shape, own)? else {
            let text = format!("`<{}>` gives no mass: its density is not read", shape.name());
            tally.remark(shape.place(), text);
            continue;
        };
        let (pose, relative_to) = collision.pose()?;
        if relative_to.is_some() {
            let text = "the pose of this shape is taken as one in the link's frame, for its mass";
            tally.remark(collision.place(), text);
        }
        parts.push(part.at(&pose));
    }
    let whole = Inertial::together(&parts).filter(|whole| whole.mass > 0.0);
    let Some(Inertial { mass, centre, inertia }) = whole else { return Ok(None) };
    let given = tag.number("mass")?.filter(|given| *given > 0.0);
    let scale = given.map_or(1.0, |given| given / mass);
    Ok(Some(Inertial { mass: mass * scale, centre, inertia: inertia * scale }))
}

/// The mass of a shape; none of one whose density is not read.
fn part(shape: Tag, density: f64) -> Fallible<Option<Inertial>> {
    if shape.name() == "cone" {
        let (radius, length) = (shape.size("radius")?, shape.size("length")?);
        let mass = density * PI * radius * radius * length / 3.0;
        let across = mass * (3.0 / 20.0 * radius * radius + 3.0 / 80.0 * length * length);
        let centre = Point3::new(0.0, 0.0, -length / 4.0);
        let moments = [across, across, mass * 0.3 * radius * radius];
        return Ok(Some(Inertial { centre, ..Inertial::along_axes(mass, moments) }));
    }
    let solid = primitive(shape)?;
    Ok(solid.map(|solid| Inertial::of_primitive(&solid, false, density)))
}

/// What is read of a shape.
const KNOWN: &[&str] = &["pose", "geometry", "material", "transparency", "surface", "density"];
/// Settings of the simulator and the viewer.
const SETTINGS: &[&str] = &[
    "cast_shadows",
    "laser_retro",
    "visibility_flags",
    "meta",
    "max_contacts",
    "auto_inertia_params",
];
/// What a material says beside its colour.
const LIGHTING: &[&str] = &[
    "script",
    "shader",
    "render_order",
    "lighting",
    "ambient",
    "specular",
    "shininess",
    "emissive",
    "double_sided",
];

/// Reads a `<visual>` or `<collision>`; `None` if it has no place in a URDF.
///
/// # Errors
/// If a number is none, or a file may not be read.
pub fn shape(reader: &mut SdfReader, tag: Tag) -> Fallible<Option<Placeable>> {
    let is_visual = tag.name() == "visual";
    for child in tag.children() {
        match child.name() {
            name if SETTINGS.contains(&name) => reader.tally.count(features::SETTINGS),
            name if KNOWN.contains(&name) => {}
            name => reader.tally.unread(format!("`<{name}>` of `<{}>`", tag.name())),
        }
    }
    if !is_visual {
        reader.friction.meet(tag, &mut reader.tally);
    }
    let Some(found) = tag.child("geometry").and_then(|geometry| geometry.children().next()) else {
        reader.tally.remark(tag.place(), format!("this `<{}>` has no shape", tag.name()));
        return Ok(None);
    };
    let (pose, relative_to) = tag.pose()?;
    let found = match found.name() {
        "mesh" => mesh(reader, found)?,
        _ => geometry(reader, found)?.map(|geometry| (geometry, Vector3::zeros())),
    };
    let Some((geometry, shift)) = found else { return Ok(None) };
    if is_flat(&geometry) {
        reader.tally.unread("shapes without a volume");
        let text = format!("this `<{}>` has no volume: it is left out", tag.name());
        reader.tally.remark(tag.place(), text);
        return Ok(None);
    }
    let pose = pose * Translation3::from(shift);
    let material = if is_visual { material(reader, tag)? } else { None };
    let name = tag.attribute("name").map(str::to_owned);
    let used = if is_visual { Use::Visual } else { Use::Collision };
    let shape = Shape { name, used, pose, geometry, material, place: tag.place() };
    Ok(Some(Placeable { shape, relative_to }))
}

/// The primitive of a tag; none of another shape.
///
/// # Errors
/// If a size is missing, or none.
pub fn primitive(tag: Tag) -> Fallible<Option<Geometry>> {
    Ok(Some(match tag.name() {
        "box" => Geometry::Box(lengths(tag, "size")?),
        "sphere" => Geometry::Sphere(tag.size("radius")?),
        "cylinder" => {
            let (radius, length) = (tag.size("radius")?, tag.size("length")?);
            Geometry::Cylinder { radius, length }
        }
        "capsule" => {
            let (radius, length) = (tag.size("radius")?, tag.size("length")?);
            Geometry::Capsule { radius, length }
        }
        "ellipsoid" => Geometry::Ellipsoid(lengths(tag, "radii")?),
        _ => return Ok(None),
    }))
}

const SIZES: &[(&str, &[&str])] = &[
    ("box", &["size"]),
    ("sphere", &["radius"]),
    ("cylinder", &["radius", "length"]),
    ("capsule", &["radius", "length"]),
    ("cone", &["radius", "length"]),
    ("ellipsoid", &["radii"]),
];

fn geometry(reader: &mut SdfReader, tag: Tag) -> Fallible<Option<Geometry>> {
    let sizes = SIZES.iter().find(|(shape, _)| *shape == tag.name());
    let sizes = sizes.into_iter().flat_map(|(_, sizes)| *sizes);
    for size in sizes.filter(|size| tag.child(size).is_none()) {
        let metres = tag.default_size(size);
        let text = format!("`<{}>` has no `<{size}>`: SDF gives it {metres} m", tag.name());
        reader.tally.remark(tag.place(), text);
    }
    let (feature, geometry) = match (primitive(tag)?, tag.name()) {
        (Some(solid), _) => (solid.feature(), solid),
        (None, "cone") => {
            let (radius, length) = (tag.size("radius")?, tag.size("length")?);
            let Some(bytes) = stl(&[Part::from(cone())]).ok() else { return Ok(None) };
            let asset = reader.assets.made(reader.gate, "meshes/unit_cone.stl", bytes);
            let asset = asset.at(tag.place())?;
            (features::CONES, Geometry::Mesh { asset, scale: [radius, radius, length] })
        }
        (None, "empty") => return Ok(None),
        (None, "plane" | "heightmap") => {
            reader.tally.count(features::SURFACES);
            return Ok(None);
        }
        (None, name) => {
            reader.tally.unread(format!("`<{name}>` of `<geometry>`"));
            return Ok(None);
        }
    };
    reader.tally.count(feature);
    Ok(Some(geometry))
}

/// Whether a shape has no volume.
fn is_flat(geometry: &Geometry) -> bool {
    match geometry {
        Geometry::Box(lengths) | Geometry::Ellipsoid(lengths) => lengths.contains(&0.0),
        Geometry::Sphere(radius) | Geometry::Capsule { radius, .. } => *radius == 0.0,
        Geometry::Cylinder { radius, length } => *radius == 0.0 || *length == 0.0,
        Geometry::Mesh { scale, .. } => scale.contains(&0.0),
    }
}

/// Three lengths that are not less than 0.
fn lengths(tag: Tag, child: &'static str) -> Fallible<[f64; 3]> {
    let Some(lengths) = tag.vector(child)? else {
        return if tag.child(child).is_none() { Ok([1.0; 3]) } else { tag.lacks(child) };
    };
    match lengths.iter().all(|length| *length >= 0.0) {
        true => Ok(lengths.into()),
        false => tag.refuse(&tag.words(child).unwrap_or_default(), "at least 0"),
    }
}

/// A mesh, and where its origin is.
fn mesh(reader: &mut SdfReader, tag: Tag) -> Fallible<Option<(Geometry, Vector3<f64>)>> {
    let Some(uri) = tag.words("uri") else {
        return tag.lacks("uri");
    };
    let scale = tag.vector("scale")?.map_or([1.0; 3], Into::into);
    tag.unread(&["uri", "scale", "submesh", "convex_decomposition"], &mut reader.tally);
    if tag.attribute("optimization").is_some() {
        reader.tally.count(features::SETTINGS);
    }
    let submesh = tag.child("submesh");
    let name = submesh.and_then(|submesh| submesh.words("name"));
    let folder = reader.folder(tag.file);
    let added = reader.assets.mesh(reader.gate, &uri, &folder, name.as_deref());
    let Some(asset) = asset(reader, tag, added)? else { return Ok(None) };
    reader.tally.count(if name.is_some() { features::SUBMESHES } else { features::MESHES });
    let is_centred = name.is_some() && submesh.is_some_and(|submesh| submesh.flag("center"));
    let shift = match is_centred {
        true => -reader.assets.middle(asset).component_mul(&Vector3::from(scale)),
        false => Vector3::zeros(),
    };
    Ok(Some((Geometry::Mesh { asset, scale }, shift)))
}

/// What became of a file.
fn asset(
    reader: &mut SdfReader,
    tag: Tag,
    added: Result<usize, ImportFault>,
) -> Fallible<Option<usize>> {
    match added {
        Ok(asset) => Ok(Some(asset)),
        // A file that is not there, or is something else, is left out, as Gazebo does.
        Err(ImportFault::File(why)) if !matches!(why, Unreachable::Outside { .. }) => {
            let text = format!("{why}; it is left out");
            reader.tally.say(features::MISSING_MESHES, tag.place(), text);
            Ok(None)
        }
        Err(why) => Err(at(tag.place(), why)),
    }
}

fn material(reader: &mut SdfReader, visual: Tag) -> Fallible<Option<Material>> {
    let opacity = 1.0 - visual.number("transparency")?.unwrap_or_default().clamp(0.0, 1.0);
    let Some(tag) = visual.child("material") else { return Ok(None) };
    let beside = tag.children().filter(|child| LIGHTING.contains(&child.name())).count();
    if beside > 0 {
        reader.tally.count(features::LIGHTING);
    }
    let mut known = LIGHTING.to_vec();
    known.extend(["diffuse", "pbr"]);
    tag.unread(&known, &mut reader.tally);
    let rgba = color(tag)?.map(|[r, g, b, a]| [r, g, b, a * opacity]);
    if rgba.is_some() {
        reader.tally.count(features::COLOURS);
    }
    let flows = tag.child("pbr").into_iter().flat_map(Tag::children);
    let map = flows.filter_map(|flow| flow.child("albedo_map")).next();
    let mut texture = None;
    if let Some((map, uri)) = map.map(|map| (map, map.text())).filter(|(_, uri)| !uri.is_empty()) {
        let folder = reader.folder(tag.file);
        let added = reader.assets.image(reader.gate, &uri, &folder);
        texture = asset(reader, map, added)?;
        if texture.is_some() {
            reader.tally.count(features::TEXTURES);
        }
    } else if tag.child("pbr").is_some() && beside == 0 {
        reader.tally.count(features::LIGHTING);
    }
    if rgba.is_none() && texture.is_none() {
        return Ok(None);
    }
    Ok(Some(Material { name: None, rgba, texture }))
}

/// The diffuse colour, each component from 0 to 1.
fn color(material: Tag) -> Fallible<Option<[f64; 4]>> {
    let Some(tag) = material.child("diffuse") else { return Ok(None) };
    let words = tag.text();
    let color = match words.split_whitespace().count() {
        3 => tag.numbers::<3>("three or four numbers")?.map(|[r, g, b]| [r, g, b, 1.0]),
        _ => tag.numbers::<4>("three or four numbers")?,
    };
    Ok(color.map(|color| color.map(|value| value.clamp(0.0, 1.0))))
}
