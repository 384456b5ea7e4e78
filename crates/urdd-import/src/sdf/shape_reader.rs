//! Reads visual and collision shapes.

use nalgebra::{Translation3, Vector3};

use super::super::cone::cone;
use super::super::fault::{ImportFault, Unreachable};
use super::super::features;
use super::super::model::{Geometry, Material, Shape, Use};
use super::super::refusal::{Fallible, Placing, at};
use super::reader::SdfReader;
use super::scene::Placeable;
use super::tag::Tag;
use urdd_geometry::read::Part;
use urdd_geometry::write::stl;

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

/// The sizes of shapes.
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
            reader.tally.count(features::MISSING_MESHES);
            reader.tally.remark(tag.place(), format!("{why}; it is left out"));
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
