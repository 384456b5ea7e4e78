//! Meshes that MuJoCo's compiler accepts. What it refuses was found with MuJoCo 4.0.

use urdd_export::meshes::{complete, fits_stl, is_flat};
use urdd_geometry::Mesh;

fn mesh(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Mesh {
    Mesh { vertices: vertices.to_vec(), triangles: triangles.to_vec() }
}

const CORNERS: [[f64; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

#[test]
fn a_visual_has_four_vertices_and_an_area() {
    for triangles in [&[[0, 1, 2]][..], &[[0, 1, 2], [0, 2, 1]]] {
        let mut small = mesh(&CORNERS, triangles);
        assert!(complete(&mut small));
        assert_eq!((small.vertices.len(), &small.triangles[..]), (4, triangles));
        let bounds = small.bounds().expect("bounds");
        assert_eq!(bounds.size(), [1.0, 1.0, 0.0], "it is as large as before");
    }
    let mut square =
        mesh(&[CORNERS[0], CORNERS[1], [1.0, 1.0, 0.0], CORNERS[2]], &[[0, 1, 2], [0, 2, 3]]);
    let before = square.clone();
    assert!(complete(&mut square) && square == before);
    let tiny = CORNERS.map(|corner| corner.map(|value| value * 1e-8));
    let line = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    // In binary32, its corners are one point.
    let far = CORNERS.map(|corner| corner.map(|value| 1e6 + value * 1e-3));
    for corners in [tiny, line, far, [[0.5; 3]; 3], [[1e300; 3]; 3]] {
        assert!(!complete(&mut mesh(&corners, &[[0, 1, 2]])), "{corners:?}");
    }
    assert!(!complete(&mut mesh(&[], &[])));
}

#[test]
fn thin_pieces_are_flat_where_binary32_cannot_hold_them() {
    let plate = |thickness: f64, at: f64| {
        let corner = |k: usize| {
            let on = |bit: usize| if k >> bit & 1 == 1 { 1.0 } else { 0.0 };
            [at + on(0), at + on(1), on(2) * thickness + at]
        };
        mesh(&[0, 1, 2, 3, 4, 5, 6, 7].map(corner), &[])
    };
    for (thickness, at, expected) in [
        (0.1, 0.0, false),
        (1e-5, 0.0, false),
        (1e-7, 0.0, true),
        (0.0, 0.0, true),
        (1e-3, 100.0, false),
        (1e-5, 100.0, true),
    ] {
        assert_eq!(is_flat(&plate(thickness, at)), expected, "{thickness} {at}");
    }
    assert!(is_flat(&mesh(&CORNERS, &[])));
}

#[test]
fn large_pieces_are_in_files_without_a_limit() {
    let faces = |count: usize| mesh(&CORNERS, &vec![[0, 1, 2]; count]);
    assert!(fits_stl(&faces(200_000)) && !fits_stl(&faces(200_001)));
    assert!(!fits_stl(&mesh(&[[0.0; 3], [2e9, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]])));
}
