//! The points that stand for shapes.

use std::f64::consts::PI;
use std::sync::Arc;

use urdd_format::urdf::{Cuboid, Cylinder, Geometry, Sphere};
use urdd_lint::hull::solid;

#[test]
fn shapes_share_their_points_and_have_their_volume() {
    let volume = |shape: &Geometry| {
        let (solid, scale) = solid(shape).expect("no mesh");
        solid.hull.as_ref().expect("a volume").volume * scale.product()
    };
    let of_box = Geometry::Box(Cuboid { size: [2.0, 3.0, 5.0] });
    assert!((volume(&of_box) - 30.0).abs() < 1e-12);
    // A prism over the regular polygon around the circle.
    let cylinder = Geometry::Cylinder(Cylinder { radius: 2.0, length: 3.0 });
    let polygon = 32.0 * (PI / 32.0).tan() * 4.0;
    assert!((volume(&cylinder) / (3.0 * polygon) - 1.0).abs() < 1e-12);
    let sphere = |radius| Geometry::Sphere(Sphere { radius });
    let ratio = volume(&sphere(0.5)) / (4.0 / 3.0 * PI * 0.125);
    assert!((0.98..1.02).contains(&ratio), "{ratio}");
    let [one, other] = [1.0, 7.0].map(|radius| solid(&sphere(radius)).expect("no mesh"));
    assert!(Arc::ptr_eq(&one.0, &other.0));
}
