//! Primitives, and where prims are.

use nalgebra::{Isometry3, Matrix3};

use super::super::shapes::thick;
use super::prim::Prim;
use super::surface::extent;
use super::value::{doubles, wxyz};
use urdd_geometry::primitives::Primitive;
use urdd_xml::number::number;

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
