//! The rules of `shapes::needlessly_large`.

use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::primitives::{cuboid, sphere};
use urdd_validate::rules::shapes::fit::*;

#[test]
fn a_bound_is_near_the_smallest_radius_and_never_above_it() {
    for mesh in [cuboid([1.0, 2.0, 3.0]), sphere(0.7)] {
        let hull = ConvexHull::new(&mesh.vertices).unwrap();
        let least = BoundingSphere::around(&hull).radius;
        assert!(exceeds(&mesh.vertices, 0.97 * least));
        assert!(!exceeds(&mesh.vertices, least * (1.0 + 1e-9)));
    }
    assert!(!exceeds(&[], 0.0));
    assert!(!exceeds(&[[1.0; 3]; 2], 0.0));
}
