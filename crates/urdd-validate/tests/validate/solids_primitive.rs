//! The true surfaces of URDF's shapes, to compare tessellated ones with.

use nalgebra::Matrix3;
use urdd_format::urdf::{Capsule, Cuboid, Cylinder, Geometry, Sphere};
use urdd_geometry::primitives;
use urdd_validate::solids::expected::*;

fn at_origin(geometry: Geometry) -> Primitive {
    Primitive::new(&geometry, Matrix3::identity(), [0.0; 3]).expect("no mesh")
}

#[test]
fn distances_have_closed_forms() {
    let box_ = at_origin(Geometry::Box(Cuboid { size: [2.0, 4.0, 6.0] }));
    assert_eq!(box_.distance([1.0, 0.5, -2.0]), 0.0);
    assert_eq!(box_.distance([0.0, 0.0, 0.0]), -1.0);
    assert_eq!(box_.distance([4.0, 6.0, 0.0]), 5.0);
    let cylinder = at_origin(Geometry::Cylinder(Cylinder { radius: 1.0, length: 2.0 }));
    assert_eq!(cylinder.distance([1.0, 0.0, 0.3]), 0.0);
    assert_eq!(cylinder.distance([0.2, 0.0, 1.0]), 0.0);
    assert_eq!(cylinder.distance([0.0, 4.0, 5.0]), 5.0);
    let capsule = at_origin(Geometry::Capsule(Capsule { radius: 1.0, length: 2.0 }));
    assert_eq!(capsule.distance([0.0, 0.0, 2.0]), 0.0);
    assert_eq!(capsule.distance([0.0, 1.0, -1.0]), 0.0);
    let turn = nalgebra::Rotation3::from_euler_angles(0.0, std::f64::consts::FRAC_PI_2, 0.0);
    let turned = Geometry::Capsule(Capsule { radius: 1.0, length: 2.0 });
    let turned = Primitive::new(&turned, turn.into_inner(), [0.0, 0.0, 5.0]).expect("no mesh");
    assert!(turned.distance([2.0, 0.0, 5.0]).abs() < 1e-15);
}

#[test]
fn areas_are_those_of_fine_tessellations() {
    // Inscribed surfaces with 32 corners a circle are up to 2 % smaller.
    for (geometry, mesh) in [
        (Geometry::Box(Cuboid { size: [1.0, 2.0, 3.0] }), primitives::cuboid([1.0, 2.0, 3.0])),
        (Geometry::Cylinder(Cylinder { radius: 0.5, length: 2.0 }), primitives::cylinder(0.5, 2.0)),
        (Geometry::Capsule(Capsule { radius: 0.5, length: 2.0 }), primitives::capsule(0.5, 2.0)),
        (Geometry::Sphere(Sphere { radius: 0.5 }), primitives::sphere(0.5)),
    ] {
        let ratio = mesh.area() / at_origin(geometry).area();
        assert!((0.98..=1.0 + 1e-12).contains(&ratio), "{ratio}");
    }
}
