//! Faces that are not convex, cut as a mesh cuts them (SPEC 7.8).

use urdd_geometry::Mesh;
use urdd_geometry::surface;
use urdd_validate::solids::cut::*;
use urdd_validate::solids::expected::Expected;

/// The trial's L-shaped face, uncut, beside a triangle that fills its notch.
fn expected() -> Expected {
    let points = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]];
    let vertices = points.map(|[x, y]| [f64::from(x), f64::from(y), 0.0]).to_vec();
    let mesh = Mesh {
        vertices,
        triangles: vec![
            [0, 0, 0],
            [0, 1, 2],
            [0, 2, 3],
            [0, 3, 4],
            [0, 4, 5],
            [0, 0, 0],
            [2, 4, 3],
        ],
    };
    Expected { mesh, primitives: Vec::new(), extent: 2.0 }
}

fn accepts(triangles: &[[u32; 3]]) -> bool {
    let expected = expected();
    let mut found = expected.mesh.clone();
    found.triangles = triangles.to_vec();
    found.triangles.push([2, 4, 3]);
    as_found(expected, &found).is_some_and(|cut| {
        !surface::difference(&cut.mesh, &found, 1e-6, surface::Likeness::SameSurface).is_any()
    })
}

#[test]
fn every_cut_that_does_not_overlap_passes() {
    assert!(accepts(&[[0, 1, 2], [0, 2, 3], [5, 0, 3], [3, 4, 5]]));
    assert!(accepts(&[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]));
    assert!(accepts(&[[1, 2, 3], [0, 1, 3], [0, 3, 5], [3, 4, 5]]));
    // Turned round, missing, doubled elsewhere, across the notch.
    assert!(!accepts(&[[0, 2, 1], [0, 2, 3], [5, 0, 3], [3, 4, 5]]));
    assert!(!accepts(&[[0, 1, 2], [0, 2, 3], [5, 0, 3]]));
    assert!(!accepts(&[[0, 1, 2], [0, 2, 4], [0, 4, 5]]));
    assert!(!accepts(&[[0, 1, 2], [0, 2, 3], [5, 0, 3], [3, 4, 5], [0, 1, 3]]));
}
