use super::*;
use crate::primitives::{cuboid, cylinder, sphere};

#[test]
fn a_box_has_three_normals_at_each_corner() {
    let found = shaded(&cuboid([1.0, 2.0, 3.0]));
    assert_eq!(found.mesh.vertices.len(), 24);
    assert_eq!(found.mesh.vertices[..8], cuboid([1.0, 2.0, 3.0]).vertices);
    for (triangle, normal) in
        found.mesh.triangles.iter().flat_map(|t| t.map(|v| (*t, found.normals[v as usize])))
    {
        let face = unit(double_area_normal(found.mesh.corners(triangle)));
        assert_eq!(face.map(|x| x as f32), Vector3::from(normal));
    }
}

#[test]
fn a_sphere_has_the_normals_of_a_sphere() {
    let mesh = sphere(0.5);
    let found = shaded(&mesh);
    assert_eq!(found.mesh, mesh);
    for (vertex, normal) in found.mesh.vertices.iter().zip(&found.normals) {
        let radial = Vector3::from(*vertex) / 0.5;
        let normal = Vector3::from(normal.map(f64::from));
        assert!((normal.norm() - 1.0).abs() < 1e-6);
        // One degree.
        assert!(normal.dot(&radial) > 0.9998, "{vertex:?} {normal:?}");
    }
}

#[test]
fn a_cylinder_is_round_and_its_caps_are_flat() {
    let found = shaded(&cylinder(0.1, 0.4));
    for (vertex, normal) in found.mesh.vertices.iter().zip(&found.normals) {
        let along = f64::from(normal[2]);
        let radial = (f64::from(normal[0]) * vertex[0] + f64::from(normal[1]) * vertex[1]) / 0.1;
        assert!(along.abs() > 0.9999 || radial > 0.9999, "{vertex:?} {normal:?}");
    }
}
