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

#[test]
fn depth_is_the_way_out() {
    let a = cuboid([0.0; 3], [1.0; 3]);
    let b = cuboid([0.9, 0.2, 0.2], [2.0, 0.8, 0.8]);
    for (x, y) in [(&a, &b), (&b, &a)] {
        assert!((x.depth(y) - 0.1).abs() < 1e-12);
    }
    assert!(a.depth(&cuboid([1.1, 0.0, 0.0], [2.0, 1.0, 1.0])) <= 0.0);
    // Two wedges whose edges cross: the way out is along the cross product of the edges, z.
    let wedge =
        |points: [[f64; 3]; 6]| Hull::of(points.into_iter().map(Vector3::from)).expect("a hull");
    let lower = wedge([
        [-1.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [-1.0, -1.0, -1.0],
        [1.0, -1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [1.0, 1.0, -1.0],
    ]);
    let upper = wedge([
        [0.0, -1.0, -0.01],
        [0.0, 1.0, -0.01],
        [-1.0, -1.0, 1.0],
        [-1.0, 1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, 1.0],
    ]);
    assert!((lower.depth(&upper) - 0.01).abs() < 1e-12);
}
