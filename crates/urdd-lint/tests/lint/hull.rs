//! Convex hulls with what rules ask of them.

use nalgebra::Vector3;
use urdd_lint::hull::*;

fn cuboid(low: [f64; 3], high: [f64; 3]) -> Hull {
    let corners = (0..8).map(|bits| {
        let pick = |axis: usize| {
            if bits & (1 << axis) == 0 { low[axis] } else { high[axis] }
        };
        Vector3::new(pick(0), pick(1), pick(2))
    });
    Hull::of(corners).expect("a hull")
}

#[test]
fn an_even_box_has_its_moments() {
    // The moments of a box with edges a, b, c are (b² + c²)/12 and so on: their sum is (a² + b² + c²)/6.
    let hull = cuboid([1.0, 2.0, 3.0], [1.4, 2.6, 4.0]);
    let sum = (0.4_f64.powi(2) + 0.6_f64.powi(2) + 1.0) / 6.0;
    assert!((hull.even_trace() - sum).abs() < 1e-12);
    assert!((hull.volume - 0.24).abs() < 1e-12);
    assert!((hull.outside(&Vector3::new(1.9, 2.3, 3.5)) - 0.5).abs() < 1e-12);
    assert!((hull.outside(&Vector3::new(1.3, 2.3, 3.5)) + 0.1).abs() < 1e-12);
}
