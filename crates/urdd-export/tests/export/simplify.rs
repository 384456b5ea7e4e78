//! Visual geometry with fewer triangles, by meshoptimizer's edge collapses. The deviation is measured on both surfaces.

use urdd_export::simplify::simplify_all;
use urdd_export::{Detail, Note};
use urdd_geometry::Mesh;
use urdd_geometry::read::{Part, Texture};

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
    let [mut few, mut small] = [full.clone(), sphere(0.01, 5)].map(Part::from);
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
    assert!(few.mesh.vertices.iter().all(on_it));
    assert!((100..4000).contains(&micrometres), "{micrometres}");
    let volume = few.mesh.signed_volume() / full.signed_volume();
    assert!((0.97..1.0).contains(&volume), "{volume}");
    assert_eq!(simplify_all(vec![&mut few], Detail::Triangles(10_000)), None);
}

/// A plane of `n` by `n` quads with a texture that has a seam: its halves are far from each other in the image.
#[test]
fn a_texture_stays_where_it_is() {
    let n = 20;
    let mut plane = Part { texture: Some(Texture::default()), ..Part::default() };
    let uv_of = |[x, y, _]: [f64; 3], left: bool| match left {
        true => [0.25 * x, y],
        false => [0.5 + 0.25 * x, y],
    };
    for i in 0..n {
        for j in 0..n {
            let point = |i: u32, j: u32| [f64::from(i) / 20.0, f64::from(j) / 20.0, 0.0];
            let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
            for corners in [[a, b, c], [a, c, d]] {
                let first = plane.mesh.vertices.len() as u32;
                plane.mesh.vertices.extend(corners);
                plane.mesh.triangles.push([first, first + 1, first + 2]);
                let uvs = corners.map(|corner| uv_of(corner, i < n / 2));
                plane.texture.as_mut().expect("texture").uv.extend(uvs);
            }
        }
    }
    let note = simplify_all(vec![&mut plane], Detail::Ratio(0.1)).expect("fewer");
    let uv = &plane.texture.as_ref().expect("texture").uv;
    assert_eq!(uv.len(), plane.mesh.vertices.len());
    assert!(plane.mesh.triangles.len() <= 80, "{note}");
    assert!((plane.mesh.area() - 1.0).abs() < 1e-6);
    for triangle in &plane.mesh.triangles {
        let corners = plane.mesh.corners(*triangle);
        let middle: f64 = corners.iter().map(|corner| corner[0] / 3.0).sum();
        for (index, corner) in triangle.iter().zip(corners) {
            let wanted = uv_of(corner, middle < 0.5);
            let error = [0, 1].map(|k| (uv[*index as usize][k] - wanted[k]).abs());
            assert!(error.iter().all(|error| *error < 1e-6), "{corner:?} {error:?}");
        }
    }
}
