//! Points on the surface of a link, the target of its spheres' surface.

use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_spheres::frame::Point;
use urdd_spheres::surface::*;

fn cube(at: f64, size: f64) -> Mesh {
    let corner = |k: usize| [0, 1, 2].map(|axis| at + size * ((k >> axis & 1) as f64));
    let corners: Vec<Point> = (0..8).map(corner).collect();
    ConvexHull::new(&corners).expect("a hull").into_mesh()
}

#[test]
fn points_are_on_the_outside_of_all_pieces_together() {
    let pieces = [cube(0.0, 1.0), cube(0.5, 1.0)];
    let found = points(&pieces, 2000);
    // Three of each cube's six faces have a quarter in the other cube.
    assert!((found.len() as f64 / 2000.0 - 0.875).abs() < 0.01);
    for p in &found {
        let on = |low: f64, high: f64| {
            p.iter().any(|x| (x - low).abs() < 1e-12 || (x - high).abs() < 1e-12)
        };
        let inside = |low: f64, high: f64| p.iter().all(|x| low + 1e-6 < *x && *x < high - 1e-6);
        assert!(on(0.0, 1.0) || on(0.5, 1.5));
        assert!(!inside(0.0, 1.0) && !inside(0.5, 1.5));
    }
}

#[test]
fn a_piece_without_area_has_its_vertices() {
    let line = Mesh { vertices: vec![[0.0; 3], [1.0, 0.0, 0.0]], ..Mesh::default() };
    assert_eq!(points(&[line], 10), vec![[0.0; 3], [1.0, 0.0, 0.0]]);
}
