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
    let (tag, sizes, scale) = match thick(primitive) {
        Primitive::Box(half) => ("Cube", vec![("size", 1.0)], Some(half.map(|half| 2.0 * half))),
        Primitive::Sphere { radius } => ("Sphere", vec![("radius", radius)], None),
        Primitive::Cylinder { radius, half } => {
            ("Cylinder", vec![("radius", radius), ("height", 2.0 * half)], None)
        }
        Primitive::Capsule { radius, half } => {
            ("Capsule", vec![("radius", radius), ("height", 2.0 * half)], None)
        }
    };
    let half = match scale {
        Some(_) => [0.5; 3],
        None => thick(primitive).half_extents(&Matrix3::identity()),
    };
    let mut prim = Prim::new(tag, name);
    for (key, value) in sizes {
        prim.set(&format!("double {key}"), number(value));
    }
    if matches!(tag, "Cylinder" | "Capsule") {
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
