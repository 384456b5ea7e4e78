//! Collision geometry, which is not rendered: convex meshes, boxes and spheres. And visual geometry: a mesh for each link, with a
//! subset of faces for each of its colours and textures.
//!
//! What is long or is there several times has a file of its own, with its materials. Links share it as an instance.

use std::collections::HashMap;

use nalgebra::{Isometry3, Matrix3, Vector3};

use super::prim::{
    COLLISIONS, Filters, Paths, Prim, VISUAL_PRIMITIVES, VISUALS, array, asset, doubles, float,
    floats, path_of_shape, wxyz,
};
use crate::meshes::{Look, Looks, is_flat};
use crate::names::last;
use crate::shapes::thick;
use crate::{ExportError, FlatShapes, MeshFiles, Note, Painted, Shape, Solid, Subject};
use urdd_geometry::Mesh;
use urdd_geometry::primitives::Primitive;
use urdd_geometry::read::Texture;
use urdd_xml::number::number;

/// Adds the shapes to the links, in link order. They have the material of that path.
pub(super) fn add_shapes(
    subject: &Subject,
    links: &mut [Prim],
    material: Option<&String>,
    (filters, paths): (&Filters, &Paths),
    files: &mut MeshFiles,
    notes: &mut Vec<Note>,
) -> Result<(), ExportError> {
    let shapes = subject.shapes_by_link()?;
    if shapes.iter().all(Vec::is_empty) {
        notes.push(Note::NoShapes(subject.shapes));
    }
    let flat = FlatShapes::new(subject)?;
    for (link, shapes) in shapes.into_iter().enumerate() {
        let mut holder = Prim::new("Xform", COLLISIONS);
        holder.set("uniform token purpose", "\"guide\"");
        for shape in shapes {
            let piece = shape.number;
            let mut prim = shape_prim(link, shape, &flat, files, notes)?;
            prim.apply("PhysicsCollisionAPI");
            filters.apply(&path_of_shape(&paths.links[link], piece), &mut prim);
            if let Some(material) = material {
                prim.bind("material:binding:physics", material);
            }
            holder.push(prim);
        }
        links[link].push_filled(holder);
    }
    Ok(())
}

fn shape_prim(
    link: usize,
    shape: Shape,
    flat: &FlatShapes,
    files: &mut MeshFiles,
    notes: &mut Vec<Note>,
) -> Result<Prim, ExportError> {
    let name = format!("piece_{}", shape.number);
    Ok(match shape.solid {
        Solid::Convex(mesh) | Solid::Mesh(mesh) if is_flat(&mesh) => {
            let (pose, cuboid) = flat.cuboid(&mesh, shape.number, link, notes);
            primitive(name, &pose, cuboid)
        }
        Solid::Convex(mesh) | Solid::Mesh(mesh) => {
            let mut inline = Prim::new("Mesh", name.as_str());
            set(&mut inline, &mesh, &[]);
            let text = inline.file(&[]);
            let mut prim = if text.len() > LONGEST {
                let mut prim = Prim::new("Mesh", name.as_str());
                let path = files.add_text(link, &name, text);
                prim.describe("prepend references", &asset(&path));
                prim
            } else {
                inline
            };
            prim.apply("PhysicsMeshCollisionAPI");
            prim.set("uniform token physics:approximation", "\"convexHull\"");
            prim
        }
        Solid::Primitive(pose, of) => primitive(name, &pose, of),
    })
}

/// The longest mesh that is in the file itself, bytes of text.
pub(super) const LONGEST: usize = 1 << 15;

/// Materials in one place, each once.
pub(super) struct Materials {
    path: String,
    pub scope: Prim,
    names: HashMap<String, String>,
}

impl Materials {
    pub fn new(above: &str, name: &str) -> Self {
        let path = format!("{above}/{name}");
        Materials { path, scope: Prim::new("Scope", name), names: HashMap::new() }
    }

    /// Adds what all shapes are made of, and returns its path.
    pub fn contact(&mut self, friction: f64) -> String {
        let mut material = Prim::new("Material", "contact").applying(&["PhysicsMaterialAPI"]);
        material.set("float physics:staticFriction", float(friction));
        material.set("float physics:dynamicFriction", float(friction));
        self.scope.push(material);
        format!("{}/contact", self.path)
    }

    /// The path of the material of a look; `None` if it has neither colour nor texture.
    fn of(&mut self, color: Option<[f64; 4]>, texture: Option<&str>) -> Option<String> {
        if texture.is_none() && color.is_none() {
            return None;
        }
        let color = color.unwrap_or([1.0; 4]);
        let key = format!("{texture:?} {color:?}");
        let count = self.names.len();
        let name = self.names.entry(key).or_insert_with(|| {
            let kind = if texture.is_some() { "texture" } else { "colour" };
            let name = format!("{kind}_{count}");
            let path = format!("{}/{name}", self.path);
            self.scope.push(material(&path, &name, color, texture));
            name
        });
        Some(format!("{}/{name}", self.path))
    }
}

/// Adds the visual geometry to the links, in link order.
pub(super) fn add_looks(
    all: &Looks,
    links: &mut [Prim],
    materials: &mut Materials,
    files: &mut MeshFiles,
) {
    let looks = &all.meshes;
    let mut texts = Vec::new();
    let mut count: HashMap<String, usize> = HashMap::new();
    let mut images = Vec::new();
    for (link, looks) in looks.iter().enumerate() {
        let names = files.add_images(link, looks);
        let text = if looks.is_empty() {
            String::new()
        } else {
            let mut own = Materials::new(&format!("/{VISUALS}"), "Looks");
            // Textures are beside the file.
            let beside = |path: &String| last(path).to_owned();
            let names: Vec<_> = names.iter().map(|name| name.as_ref().map(beside)).collect();
            let mut prim = visuals(looks, &names, &mut own);
            prim.push_filled(own.scope);
            prim.file(&[])
        };
        *count.entry(text.clone()).or_default() += 1;
        texts.push(text);
        images.push(names);
    }
    for (link, (looks, text)) in looks.iter().zip(texts).enumerate() {
        if looks.is_empty() {
            continue;
        }
        if text.len() > LONGEST || count[&text] > 1 {
            let path = files.add_text(link, VISUALS, text);
            let mut prim = Prim::new("Xform", VISUALS);
            prim.describe("instanceable", "true");
            prim.describe("prepend payload", &asset(&path));
            links[link].push(prim);
        } else {
            links[link].push(visuals(looks, &images[link], materials));
        }
    }
    add_primitives(&all.primitives, links, materials);
}

/// Adds the primitives of visual geometry, in link order.
fn add_primitives(primitives: &[Vec<Painted>], links: &mut [Prim], materials: &mut Materials) {
    for (own, link) in primitives.iter().zip(links) {
        let mut holder = Prim::new("Xform", VISUAL_PRIMITIVES);
        for (place, of) in own.iter().enumerate() {
            let mut prim = primitive(format!("primitive_{place}"), &of.pose, of.primitive);
            if let Some(material) = materials.of(of.color, None) {
                prim.bind("material:binding", &material);
            }
            holder.push(prim);
        }
        link.push_filled(holder);
    }
}

fn visuals(looks: &[Look], images: &[Option<String>], materials: &mut Materials) -> Prim {
    let mut mesh = Mesh::default();
    let mut uv = Vec::new();
    let mut subsets = Vec::new();
    for (place, (look, image)) in looks.iter().zip(images).enumerate() {
        let first = mesh.triangles.len();
        mesh.append(&look.part.mesh);
        if images.iter().any(Option::is_some) {
            uv.extend(coordinates(look.part.texture.as_ref(), look.part.mesh.vertices.len()));
        }
        let texture = image.as_ref().map(|path| asset(path));
        let Some(material) = materials.of(look.part.color, texture.as_deref()) else { continue };
        let mut subset = Prim::new("GeomSubset", format!("subset_{place}"));
        subset.set("uniform token elementType", "\"face\"");
        subset.set("uniform token familyName", "\"materialBind\"");
        let faces = first..mesh.triangles.len();
        subset.set("int[] indices", array(faces.map(|face| face.to_string())));
        subset.bind("material:binding", &material);
        subsets.push((material, subset));
    }
    let mut prim = Prim::new("Mesh", "mesh");
    set(&mut prim, &mesh, &uv);
    prim.set("uniform bool doubleSided", "1");
    if let ([(material, _)], 1) = (&subsets[..], looks.len()) {
        prim.bind("material:binding", material);
    } else if !subsets.is_empty() {
        prim.set("uniform token subsetFamily:materialBind:familyType", "\"nonOverlapping\"");
        subsets.into_iter().for_each(|(_, subset)| prim.push(subset));
    }
    Prim::new("Xform", VISUALS).holding(prim)
}

/// Sets the triangles of a mesh, and where they are in its textures.
pub(super) fn set(prim: &mut Prim, mesh: &Mesh, uv: &[[f64; 2]]) {
    let corners = mesh.triangles.iter().flatten().map(ToString::to_string);
    prim.set("int[] faceVertexCounts", array(mesh.triangles.iter().map(|_| "3".to_owned())));
    prim.set("int[] faceVertexIndices", array(corners));
    prim.set("point3f[] points", array(mesh.vertices.iter().map(|point| floats(point))));
    extent(prim, &mesh.vertices);
    let normals = array(mesh.triangles.iter().map(|triangle| floats(&normal(mesh, *triangle))));
    prim.set("normal3f[] normals", format!("{normals} (interpolation = \"uniform\")"));
    prim.set("uniform token subdivisionScheme", "\"none\"");
    if !uv.is_empty() {
        let places = array(uv.iter().map(|place| floats(place)));
        prim.set("texCoord2f[] primvars:st", format!("{places} (interpolation = \"vertex\")"));
    }
}

/// The normal of a triangle, to 5 digits; that of one without area is z.
fn normal(mesh: &Mesh, triangle: [u32; 3]) -> [f64; 3] {
    let [a, b, c] = mesh.corners(triangle).map(Vector3::from);
    let normal = (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or(Vector3::z());
    normal.map(|of| (of * 1e5).round() / 1e5).into()
}

/// The box around points.
pub(super) fn extent(prim: &mut Prim, points: &[[f64; 3]]) {
    let bound = |start: f64, of: fn(f64, f64) -> f64| {
        [0, 1, 2].map(|k| points.iter().fold(start, |most, point| of(most, point[k])))
    };
    let bounds = [bound(f64::INFINITY, f64::min), bound(f64::NEG_INFINITY, f64::max)];
    prim.set("float3[] extent", array(bounds.iter().map(|bound| floats(bound))));
}

/// The texture coordinates of a mesh with so many points: those that it has, and (0, 0).
pub(super) fn coordinates(texture: Option<&Texture>, count: usize) -> Vec<[f64; 2]> {
    let mut uv = texture.map_or_else(Vec::new, |texture| texture.uv.clone());
    uv.resize(count, [0.0; 2]);
    uv
}

/// The material of a colour or of the texture in a file; its path is that of what holds it and its name.
pub(super) fn material(path: &str, name: &str, color: [f64; 4], texture: Option<&str>) -> Prim {
    let mut surface = Prim::new("Shader", "surface");
    surface.set("uniform token info:id", "\"UsdPreviewSurface\"");
    match texture {
        None => surface.set("color3f inputs:diffuseColor", floats(&linear(color))),
        Some(_) => surface
            .set("color3f inputs:diffuseColor.connect", format!("<{path}/image.outputs:rgb>")),
    }
    surface.set("float inputs:opacity", float(color[3]));
    surface.set("float inputs:roughness", "0.5");
    surface.declare("token outputs:surface");
    let mut material = Prim::new("Material", name);
    material.set("token outputs:surface.connect", format!("<{path}/surface.outputs:surface>"));
    material.push(surface);
    if let Some(file) = texture {
        let mut image = Prim::new("Shader", "image");
        image.set("uniform token info:id", "\"UsdUVTexture\"");
        image.set("asset inputs:file", file);
        image.set("token inputs:sourceColorSpace", "\"sRGB\"");
        image.set("float2 inputs:st.connect", format!("<{path}/place.outputs:result>"));
        image.set("token inputs:wrapS", "\"repeat\"");
        image.set("token inputs:wrapT", "\"repeat\"");
        image.declare("float3 outputs:rgb");
        let mut place = Prim::new("Shader", "place");
        place.set("uniform token info:id", "\"UsdPrimvarReader_float2\"");
        place.set("string inputs:varname", "\"st\"");
        place.declare("float2 outputs:result");
        material.push(image);
        material.push(place);
    }
    material
}

/// Red, green and blue as USD has them: URDF's are those of a screen (sRGB).
fn linear(color: [f64; 4]) -> [f64; 3] {
    [0, 1, 2].map(|k| match color[k].clamp(0.0, 1.0) {
        value if value <= 0.04045 => value / 12.92,
        value => ((value + 0.055) / 1.055).powf(2.4),
    })
}

/// A box is a cube of 1 m, scaled.
pub(super) fn primitive(name: String, pose: &Isometry3<f64>, primitive: Primitive) -> Prim {
    let primitive = thick(primitive);
    let extents = primitive.half_extents(&Matrix3::identity());
    let long = |radius: f64, half: f64| vec![("radius", radius), ("height", 2.0 * half)];
    let (tag, sizes, half, scale) = match primitive {
        Primitive::Box(half) => {
            ("Cube", vec![("size", 1.0)], [0.5; 3], Some(half.map(|half| 2.0 * half)))
        }
        Primitive::Sphere { radius } => ("Sphere", vec![("radius", radius)], extents, None),
        Primitive::Cylinder { radius, half } => ("Cylinder", long(radius, half), extents, None),
        Primitive::Capsule { radius, half } => ("Capsule", long(radius, half), extents, None),
    };
    let mut prim = Prim::new(tag, name);
    for (key, value) in &sizes {
        prim.set(&format!("double {key}"), number(*value));
    }
    if sizes.len() > 1 {
        prim.set("uniform token axis", "\"Z\"");
    }
    extent(&mut prim, &[half.map(|half| -half), half]);
    place(&mut prim, pose, scale);
    prim
}

/// Sets the pose of a prim in the one that holds it, and its scale.
pub(super) fn place(prim: &mut Prim, pose: &Isometry3<f64>, scale: Option<[f64; 3]>) {
    prim.set("double3 xformOp:translate", doubles(pose.translation.vector.as_slice()));
    prim.set("quatd xformOp:orient", doubles(&wxyz(&pose.rotation)));
    let mut order = "[\"xformOp:translate\", \"xformOp:orient\"]";
    if let Some(scale) = scale {
        prim.set("double3 xformOp:scale", doubles(&scale));
        order = "[\"xformOp:translate\", \"xformOp:orient\", \"xformOp:scale\"]";
    }
    prim.set("uniform token[] xformOpOrder", order);
}
