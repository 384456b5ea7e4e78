//! The volume of a union of spheres.

use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_spheres::cover::{filled, volume};

#[test]
fn the_union_of_two_spheres_by_its_closed_form() {
    let sphere = |x: f64, radius: f64| BoundingSphere { centre: [x, 0.2, -0.1], radius };
    let whole = volume(&sphere(0.0, 0.3));
    for d in [0.0, 0.1, 0.3, 0.5, 0.6, 1.0] {
        // The intersection is two caps.
        let height = (0.6_f64 - d).max(0.0);
        let lens = std::f64::consts::PI * (4.0 * 0.3 + d) * height * height / 12.0;
        let expected = 2.0 * whole - lens;
        let found = filled(&[sphere(0.0, 0.3), sphere(d, 0.3)]);
        assert!((found / expected - 1.0).abs() < 0.02, "{d}: {found}");
    }
    let inner = filled(&[sphere(0.0, 0.3), sphere(0.05, 0.1)]);
    assert!((inner / whole - 1.0).abs() < 1e-12);
}
