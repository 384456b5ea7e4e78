//! Whether two meshes are the same surface: meshes that differ by one change.

use urdd_geometry::Mesh;
use urdd_geometry::primitives::cuboid;
use urdd_geometry::surface::{Difference, Likeness, difference};

const TOLERANCE: f64 = 1e-6;

fn compare(a: &Mesh, b: &Mesh) -> Option<Difference> {
    compare_as(a, b, Likeness::SameTriangles)
}

fn compare_as(a: &Mesh, b: &Mesh, likeness: Likeness) -> Option<Difference> {
    Some(difference(a, b, TOLERANCE, likeness)).filter(Difference::is_any)
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
    assert_eq!(compare_as(&mesh, &more, Likeness::SameSurface), None);
    let mut turned = shuffled(&mesh);
    turned.triangles[5].swap(0, 1);
    let found = compare(&mesh, &turned).expect("a difference");
    assert_eq!((found.missing, found.extra.len(), found.turned), (0, 0, 1));
    let found = compare_as(&mesh, &turned, Likeness::SameSurface);
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

/// A box, and a triangle of a height in tolerances beside it, which is moved up by some more.
fn with_sliver(height: f64, up: f64) -> Mesh {
    let mut mesh = cuboid([1.0, 2.0, 3.0]);
    let first = mesh.vertices.len() as u32;
    let [low, high] = [up, up + height].map(|z| 4.0 + z * TOLERANCE);
    mesh.vertices.extend([[5.0, 5.0, low], [5.5, 5.0, low], [5.25, 5.0, high]]);
    mesh.triangles.push([first, first + 1, first + 2]);
    mesh
}

/// Corners that agree may make a triangle thin in one mesh alone. It is no less of a counterpart.
#[test]
fn a_counterpart_may_be_of_any_height() {
    for likeness in [Likeness::SameTriangles, Likeness::SameSurface] {
        for (one, other) in [(1.0 - 1e-9, 1.0 + 1e-9), (0.0, 1.9), (4.9, 5.1), (5.1, 6.9)] {
            let (one, other) = (with_sliver(one, 0.0), shuffled(&with_sliver(other, -0.95)));
            assert_eq!(compare_as(&one, &other, likeness), None);
            assert_eq!(compare_as(&other, &one, likeness), None);
        }
    }
}

/// What another producer finds thinner than the tolerance, and leaves out, has up to 1 + 2 sqrt 3 = 4.46 here.
#[test]
fn a_triangle_of_five_tolerances_needs_no_counterpart() {
    let mesh = cuboid([1.0, 2.0, 3.0]);
    for likeness in [Likeness::SameTriangles, Likeness::SameSurface] {
        for height in [0.9, 1.1, 4.46, 4.99] {
            let more = with_sliver(height, 0.0);
            assert_eq!(compare_as(&mesh, &more, likeness), None);
            assert_eq!(compare_as(&more, &mesh, likeness), None);
        }
        let more = with_sliver(5.01, 0.0);
        assert_eq!(compare_as(&more, &mesh, likeness).map(|found| found.missing), Some(1));
        let found = compare_as(&mesh, &more, likeness).map(|found| found.extra.len());
        assert_eq!(found, Some(1));
    }
}
