//! Visual geometry with fewer triangles, by meshoptimizer's edge collapses. The deviation is measured on both surfaces.

use urdd_export::simplify::simplify_all;
use urdd_export::{Detail, Note};
use urdd_geometry::Mesh;

/// A sphere as a grid of `n` by `2 n` quads, with vertices of its own for each triangle, as an STL has them.
fn sphere(radius: f64, n: u32) -> Mesh {
    use std::f64::consts::PI;
    let point = |i: u32, j: u32| {
        let (a, b) = (PI * f64::from(i) / f64::from(n), PI * f64::from(j % (2 * n)) / f64::from(n));
        let ring = if i == 0 || i == n { 0.0 } else { a.sin() };
        [radius * ring * b.cos(), radius * ring * b.sin(), radius * a.cos()]
    };
    let mut mesh = Mesh::default();
    for i in 0..n {
        for j in 0..2 * n {
            let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
            for corners in [[a, b, c], [a, c, d]] {
                let first = mesh.vertices.len() as u32;
                mesh.vertices.extend(corners);
                mesh.triangles.push([first, first + 1, first + 2]);
            }
        }
    }
    mesh
}

#[test]
fn a_sphere_keeps_its_shape_with_a_tenth_of_its_triangles() {
    let full = sphere(0.1, 40);
    let [mut few, mut small] = [full.clone(), sphere(0.01, 5)];
    let both = vec![&mut few, &mut small];
    let note = simplify_all(both, Detail::Ratio(0.1)).expect("fewer");
    let Note::Simplified { from, to, micrometres } = note else {
        panic!("{note}");
    };
    assert_eq!(from, 6400 + 100);
    assert!((400..=650).contains(&to), "{to}");
    // All vertices are of the original. A flat triangle of 600 on a sphere of 0.1 m is about 0.9 mm inside of it, and
    // not all are even.
    let on_it =
        |vertex: &[f64; 3]| (vertex.iter().map(|x| x * x).sum::<f64>().sqrt() - 0.1).abs() < 1e-6;
    assert!(few.vertices.iter().all(on_it));
    assert!((100..4000).contains(&micrometres), "{micrometres}");
    let volume = few.signed_volume() / full.signed_volume();
    assert!((0.97..1.0).contains(&volume), "{volume}");
    assert_eq!(simplify_all(vec![&mut few], Detail::Triangles(10_000)), None);
}
