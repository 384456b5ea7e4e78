//! The largest radii of gyration that a geometry permits.

use nalgebra::{Matrix3, Vector3};
use urdd_lint::pose::Inertial;
use urdd_lint::rules::mass_beyond_shapes::*;

#[test]
fn a_rod_has_its_largest_moment_with_half_of_the_mass_at_each_end() {
    let rod = [Vector3::new(-1.0, 0.0, 0.0), Vector3::new(1.0, 0.0, 0.0)];
    let about = |x: f64| {
        let inertial = Inertial {
            mass: 1.0,
            center: Vector3::new(x, 0.0, 0.0),
            moments: Vector3::zeros(),
            axes: Matrix3::identity(),
        };
        largest_radii(&inertial, &rod, 0.0)
    };
    assert_eq!(about(0.0), Vector3::new(0.0, 1.0, 1.0));
    // With the centre at 0.6, 0.8 of the mass is at 1 and 0.2 at -1: 0.8 * 0.16 + 0.2 * 2.56 = 0.64.
    assert!((about(0.6) - Vector3::new(0.0, 0.8, 0.8)).norm() < 1e-12);
}
