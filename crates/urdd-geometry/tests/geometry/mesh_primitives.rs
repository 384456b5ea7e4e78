//! Tessellated primitives, against closed forms.

use std::collections::HashMap;
use std::f64::consts::PI;

use urdd_geometry::Mesh;
use urdd_geometry::primitives::{RINGS, SEGMENTS, capsule, cuboid, cylinder, sphere};

/// Every edge occurs once in each direction, and Euler's formula gives one body without holes.
fn assert_closed(mesh: &Mesh) {
    let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
    for [a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry((*from, *to)).or_default() += 1;
        }
    }
    for ((from, to), count) in &edges {
        assert_eq!(*count, 1, "edge {from} {to}");
        assert_eq!(edges.get(&(*to, *from)), Some(&1), "edge {to} {from}");
    }
    assert_eq!(mesh.vertices.len() + mesh.triangles.len(), edges.len() / 2 + 2);
}

/// All of these bodies are convex and contain the origin: each face must point away from it.
fn assert_outward(mesh: &Mesh) {
    for triangle in &mesh.triangles {
        let [a, b, c] = mesh.corners(*triangle).map(nalgebra::Vector3::from);
        assert!((b - a).cross(&(c - a)).dot(&a) > 0.0, "{triangle:?}");
    }
}

fn assert_extent(mesh: &Mesh, half: [f64; 3]) {
    let bounds = mesh.bounds().unwrap();
    assert_eq!(bounds.max, half);
    assert_eq!(bounds.min, half.map(|value| -value));
}

#[test]
fn cuboid_is_a_box() {
    let mesh = cuboid([0.3, 0.5, 0.7]);
    assert_closed(&mesh);
    assert_outward(&mesh);
    assert_extent(&mesh, [0.15, 0.25, 0.35]);
    assert!((mesh.signed_volume() - 0.105).abs() < 1e-15);
}

#[test]
fn cylinder_is_a_prism_in_the_true_cylinder() {
    let (radius, length) = (0.3, 0.8);
    let mesh = cylinder(radius, length);
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (64, 124));
    assert_closed(&mesh);
    assert_outward(&mesh);
    assert_extent(&mesh, [0.3, 0.3, 0.4]);
    for [x, y, z] in &mesh.vertices {
        assert!((x.hypot(*y) - radius).abs() < 1e-15 && z.abs() == length / 2.0);
    }
    // A regular polygon of n corners has the area n / 2 r^2 sin(2 pi / n).
    let n = SEGMENTS as f64;
    let base = n / 2.0 * radius * radius * (2.0 * PI / n).sin();
    assert!((mesh.signed_volume() - base * length).abs() < 1e-14);
    let wall = n * 2.0 * radius * (PI / n).sin() * length;
    assert!((mesh.area() - (2.0 * base + wall)).abs() < 1e-14);
}

#[test]
fn capsule_has_its_vertices_on_the_true_surface() {
    let (radius, length) = (0.25, 0.6);
    let mesh = capsule(radius, length);
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (514, 1024));
    assert_closed(&mesh);
    assert_outward(&mesh);
    assert_extent(&mesh, [0.25, 0.25, 0.55]);
    for [x, y, z] in &mesh.vertices {
        let beyond = (z.abs() - length / 2.0).max(0.0);
        assert!((x.hypot(*y).hypot(beyond) - radius).abs() < 1e-15);
    }
    let whole = PI * radius * radius * (length + 4.0 / 3.0 * radius);
    assert!(mesh.signed_volume() < whole && mesh.signed_volume() > 0.98 * whole);
    assert_eq!(RINGS * 4, SEGMENTS);
}

#[test]
fn sphere_is_round() {
    let radius = 0.7;
    let mesh = sphere(radius);
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (642, 1280));
    assert_closed(&mesh);
    assert_outward(&mesh);
    assert_extent(&mesh, [radius; 3]);
    for vertex in &mesh.vertices {
        assert!((nalgebra::Vector3::from(*vertex).norm() - radius).abs() < 1e-15);
    }
    // No face is nearer to the centre than the documented 0.46 %.
    for triangle in &mesh.triangles {
        let [a, b, c] = mesh.corners(*triangle).map(nalgebra::Vector3::from);
        let normal = (b - a).cross(&(c - a)).normalize();
        let depth = 1.0 - normal.dot(&a) / radius;
        assert!(depth < 0.0047, "{depth}");
    }
}

#[test]
fn flat_primitives_have_no_volume_and_do_not_panic() {
    assert_eq!(cuboid([1.0, 1.0, 0.0]).area(), 2.0);
    assert_eq!(cylinder(0.0, 1.0).signed_volume(), 0.0);
    let mut ball = capsule(0.5, 0.0);
    ball.weld();
    ball.drop_degenerate();
    assert_closed(&ball);
    assert_eq!(sphere(0.0).area(), 0.0);
}
