//! Meshes: points and triangles, and what is bound to them.

use nalgebra::{Isometry3, Matrix3, Vector3};

use super::prim::{Prim, array, doubles, float, floats, wxyz};
use crate::shapes::thick;
use urdd_geometry::Mesh;
use urdd_geometry::primitives::Primitive;
use urdd_geometry::read::Texture;
use urdd_xml::number::number;

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
