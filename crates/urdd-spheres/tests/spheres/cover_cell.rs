//! A cell of a link: convex parts, and their smallest enclosing sphere.

use nalgebra::Vector3;
use urdd_spheres::cover::*;

fn box_of(size: [f64; 3]) -> Vec<[f64; 3]> {
    let corner = |k: usize| std::array::from_fn(|axis| size[axis] * ((k >> axis & 1) as f64));
    (0..8).map(corner).collect()
}

#[test]
fn the_spheres_of_a_bar_hold_it_and_shrink() {
    let mut cells = vec![Cell::new(&[box_of([1.0, 0.1, 0.1])])];
    for _ in 0..7 {
        assert!(cut(&mut cells).is_some());
    }
    let last: f64 = cells.iter().map(|cell| volume(&cell.sphere)).sum();
    // Eight cubes of 0.125 x 0.1 x 0.1 would be best.
    let best =
        8.0 * 4.0 / 3.0 * std::f64::consts::PI * (0.125f64.hypot(0.1f64.hypot(0.1)) / 2.0).powi(3);
    assert!(last < 1.6 * best, "{last}, and {best} is best");
    for k in 0..=1000 {
        for corner in box_of([0.0, 0.1, 0.1]) {
            let point = Vector3::new(f64::from(k) / 1000.0, corner[1], corner[2]);
            let held = cells.iter().any(|cell| {
                (point - Vector3::from(cell.sphere.centre)).norm() <= cell.sphere.radius + 1e-12
            });
            assert!(held, "{point}");
        }
    }
}

#[test]
fn points_on_a_line_stay_inside() {
    let line = vec![[0.0; 3], [1.0, 0.0, 0.0]];
    let cell = Cell::new(&[line, box_of([0.2, 0.2, 0.2])]);
    if let Some(halves) = cell.cut() {
        for point in [[0.0; 3], [1.0, 0.0, 0.0]] {
            let held = halves.iter().any(|half| {
                (Vector3::from(point) - Vector3::from(half.sphere.centre)).norm()
                    <= half.sphere.radius + 1e-12
            });
            assert!(held);
        }
    }
}
