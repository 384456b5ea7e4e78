//! Whether two meshes are the same surface: meshes that differ by one change.

use urdd_geometry::Mesh;
use urdd_geometry::primitives::cuboid;
use urdd_geometry::surface::{Difference, Likeness, difference};

const TOLERANCE: f64 = 1e-6;

fn compare(a: &Mesh, b: &Mesh) -> Option<Difference> {
    difference(a, b, TOLERANCE, Likeness::SameTriangles)
}

/// The triangles in reverse order, each with another first corner, without shared vertices.
fn shuffled(mesh: &Mesh) -> Mesh {
    let mut other = Mesh::default();
    for triangle in mesh.triangles.iter().rev() {
        let [a, b, c] = mesh.corners(*triangle);
        let first = other.vertices.len() as u32;
        other.vertices.extend([b, c, a]);
        other.triangles.push([first, first + 1, first + 2]);
    }
    other
}

#[test]
fn order_and_shared_vertices_do_not_matter() {
    let mesh = cuboid([1.0, 2.0, 3.0]);
    assert_eq!(compare(&mesh, &mesh), None);
    assert_eq!(compare(&mesh, &shuffled(&mesh)), None);
}

#[test]
fn a_moved_corner_is_told_with_its_distance() {
    let mesh = cuboid([1.0, 2.0, 3.0]);
    let mut near = shuffled(&mesh);
    near.vertices[4][1] += 0.9 * TOLERANCE;
    assert_eq!(compare(&mesh, &near), None);
    let mut far = mesh.clone();
    far.vertices[7][2] += 0.25;
    let found = compare(&mesh, &far).expect("a difference");
    assert!(found.missing > 0 && found.missing == found.extra.len());
    assert!((found.distance - 0.25).abs() < 1e-12, "{found:?}");
}

#[test]
fn a_triangle_too_many_too_few_or_turned_round_is_told() {
    let mesh = cuboid([1.0, 2.0, 3.0]);
    let mut fewer = mesh.clone();
    fewer.triangles.pop();
    let found = compare(&mesh, &fewer).expect("a difference");
    assert_eq!((found.missing, found.extra.len(), found.turned), (1, 0, 0));
    let mut more = shuffled(&mesh);
    more.triangles.push(more.triangles[3]);
    let found = compare(&mesh, &more).expect("a difference");
    assert_eq!((found.missing, found.extra.len(), found.turned), (0, 1, 0));
    assert_eq!(difference(&mesh, &more, TOLERANCE, Likeness::SameSurface), None);
    let mut turned = shuffled(&mesh);
    turned.triangles[5].swap(0, 1);
    let found = compare(&mesh, &turned).expect("a difference");
    assert_eq!((found.missing, found.extra.len(), found.turned), (0, 0, 1));
    let found = difference(&mesh, &turned, TOLERANCE, Likeness::SameSurface);
    assert_eq!(found.expect("a difference").turned, 1);
}

#[test]
fn triangles_without_an_area_count_for_nothing() {
    let mesh = cuboid([1.0, 2.0, 3.0]);
    let mut more = shuffled(&mesh);
    let first = more.vertices.len() as u32;
    more.vertices.extend([[5.0, 5.0, 5.0], [5.0, 5.0, 6.0], [5.0, 5.0, 7.0]]);
    more.triangles.push([first, first + 1, first + 2]);
    assert_eq!(compare(&mesh, &more), None);
    assert_eq!(compare(&more, &mesh), None);
}
